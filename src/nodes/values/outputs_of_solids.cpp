// Outputs of solids as values, and outputs that are solids as solids.
#include "base/text/text.h"
#include "design/spec.h"
#include "nodes/common/made_fields.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct OutputOf {
  SolidName solid;
  std::string name;
  size_t count = 1;  // of its numbers; set when the node is made

  static Spec<OutputOf> spec() {
    return {"output_of",
            "An output of a solid, or of what is inside it, such as \"along\" of struts and \"cell\" of a tile, at the "
            "point where the value is used.",
            {{"solid", &OutputOf::solid, "The solid that has the output", required()},
             {"name", &OutputOf::name, "Name of the output", required()}},
            no_inputs,
            "cube(9, mix(\"red\", \"blue\", output_of(strut((-4, 0, 0), (4, 0, 0), 1), \"along\")));",
            {{"value", &OutputOf::value, "An output that is a number"},
             {"vector", &OutputOf::vector, "An output of three numbers, or the colour of one of four"}}};
  }

  bool complete(const Reader& reader) {
    if (const OutputType* type = solid.node->output_type(name); type && type->form == OutputForm::numbers) {
      count = std::max<size_t>(1, type->parts.size());
      return true;
    }
    std::vector<std::string> known = solid.node->output_names();
    std::erase_if(known,
                  [&](const std::string& one) { return solid.node->output_type(one)->form != OutputForm::numbers; });
    std::string hint = did_you_mean(name, known);
    if (hint.empty()) hint = known.empty() ? "it has no outputs" : "it has " + join(known, ", ");
    reader.diagnostics.error(Code::unknown_output, reader.where, "the solid has no output \"" + name + '"', hint,
                             {{"output", name}});
    return false;
  }

  bool gives(size_t output) const { return output == (count == 1 ? 0 : 1); }

  Field value(const Ask& ask) const { return ask.in.output_of(solid, name, ask.p)[0]; }
  VectorField vector(const Ask& ask) const {
    const Numbers4 numbers = ask.in.output_of(solid, name, ask.p);
    return {numbers[0], numbers[1], numbers[2]};
  }
};

struct SolidOf {
  SolidName solid;

  static Spec<SolidOf> spec() {
    return {"solid_of",
            "An output that is a solid or a region, as a solid; or the solid that is given, as it is.",
            {{"solid", &SolidOf::solid, "The output, or a solid", required()}},
            no_inputs,
            "solid_of(sphere(5));"};
  }

  Metric metric() const { return is_node() ? solid.node->metric() : Metric::implicit(); }
  Box reach(const Inputs&, const Box& where, double margin) const { return box_of(solid, where, margin); }
  Field distance(const Inputs& in, const Point& p) const { return in.distance_to(solid, p); }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    return border == Border::included ? in.inside_of(solid, p) : at_most(in.distance_to(solid, p), 0, border);
  }
  Composition composition(const Inputs& in, const Point& p, Demand) const { return in.composition_of(solid, p); }

 private:
  bool is_node() const { return solid.node->type().is_solid(); }
};

}  // namespace

void add_output_of(Registry& registry) { registry.add<OutputOf>("values"); }
void add_solid_of(Registry& registry) { registry.add<SolidOf>("parts"); }

}  // namespace ombre::nodes
