// Supports, which hold a part up while it is printed.
#include "design/source_loader.h"
#include "design/spec.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Support {
  double angle = 0;
  MaterialName material;
  double clearance = 0;
  std::optional<Vec3> pitch;
  StagePtr stage;  // set when the node is made

  static Spec<Support> spec() {
    Domain angles = unit::degrees;
    angles.least = 0;
    angles.greatest = 90;
    Spec<Support> spec{
        "support",
        "The supports that the solid in its braces needs when it is built layer by layer. They stand on its lowest "
        "layer or on parts of the solid below. The solid itself is not included.",
        {{"angle", &Support::angle,
          "Angle from the vertical up to which overhanging surfaces support themselves; 0: all overhangs are supported",
          angles},
         {"material", &Support::material, "Its material; none: the one that the materials file marks as support"},
         {"clearance", &Support::clearance, "Gap between the supports and the solid", unit::not_negative_mm},
         {"pitch", &Support::pitch, "Size of the cells with which supports are computed; none: the job's voxels",
          unit::positive_mm}},
        one_solid,
        "support(angle=45) { cylinder(3, 20); translate(0, 0, 11) rectprism((20, 20, 2)); }"};
    spec.parameters[1].fill = [](Support& node, const Reader& reader) {
      if (!node.material.is_given()) node.material.material = reader.materials.support();
    };
    return spec;
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (!material.is_given()) {
      reader.diagnostics.error(Code::parameter_missing, reader.where,
                               "support has no material, and no material of the design is marked as support",
                               "write " + spelled::parameter("material", '"' + reader.materials.first().name + '"') +
                                   ", or add \"support\": true to one in the materials file",
                               {{"node", "support"}, {"parameter", "material"}});
      return false;
    }
    if (!reader.loader) return reader.refuse("supports cannot be found here");
    if (clearance > 0 && inputs[0]->metric().is_implicit())
      reader.diagnostics.warning(Code::distance_unknown, reader.where,
                                 "clearance needs distances, but this shape only gives a sign",
                                 "the result may not be in mm; redistance gives it distances");
    stage = reader.loader->support(inputs[0], {angle, pitch}, reader);
    return stage != nullptr;
  }

  Metric metric(const Inputs& in) const { return weaker(Metric::bounded(), in.metric(0)); }

  Box reach(const Inputs&, const Box& where, double margin) const {
    return intersect(stage->bounds().expanded(margin), where);
  }

  Field distance(const Inputs& in, const Point& p) const {
    return max(read(in, "distance", p), clearance - in.distance(0, p));
  }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    const Field is_free = clearance > 0 ? at_most(p.constant(clearance), in.distance(0, p), border)
                                        : logical_not(in.membership(0, p, other(border)));
    return logical_and(truth(read(in, "inside", p)), is_free);
  }

  Composition composition(const Inputs& in, const Point& p, Demand) const {
    return Composition::pure(in.material(material), p.constant(1));
  }
  // Supports do not have the solid's attributes.
  std::optional<Field> attribute(const Inputs& in, std::string_view name, const Point& p, Demand) const {
    return p.constant(in.declaration(name).default_value);
  }

 private:
  Field read(const Inputs& in, const char* channel, const Point& p) const {
    const program::SourceField columns = in.staged(stage);
    return p.builder().source(columns, columns->channel(channel), p.x, p.y, p.z);
  }
};

}  // namespace

void add_supports(Registry& registry) { registry.add<Support>("supports"); }

}  // namespace ombre::nodes
