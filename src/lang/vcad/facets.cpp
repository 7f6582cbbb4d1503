#include "lang/vcad/facets.h"

#include <algorithm>

#include "base/math/vec.h"

namespace ombre::lang {
namespace {

using design::NodePtr;
using design::NodeType;
using design::Reader;

constexpr double least_round = 30;  // number of sides from which a circle counts as round

constexpr std::string_view always_round[] = {"ellipsoid", "torus", "strut", "revolve", "tube", "text"};

// Returns a corner of a polygon around the z axis, whose first corner lies on +x.
Vec3 on_circle(double radius, double degrees) { return Affine::rotation({0, 0, 1}, degrees)({radius, 0, 0}); }

void add_ring(DataList& points, int sides, double radius, double z) {
  for (int n = 0; n < (radius > 0 ? sides : 1); ++n) {
    const Vec3 corner = on_circle(radius, 360.0 * n / sides);
    points.emplace_back(DataList{Data(corner.x), Data(corner.y), Data(z)});
  }
}

// Returns the points of a ball whose rings lie half a step from the poles, as in OpenSCAD.
DataList ball_points(int sides, double radius) {
  DataList points;
  const int rings = (sides + 1) / 2;
  for (int ring = 0; ring < rings; ++ring) {
    const Vec3 profile = on_circle(radius, 180 * (ring + 0.5) / rings);
    add_ring(points, sides, profile.y, profile.x);
  }
  return points;
}

DataList frustum_points(int sides, double base, double top, double height) {
  DataList points;
  add_ring(points, sides, base, -height / 2);
  add_ring(points, sides, top, height / 2);
  return points;
}

DataList polygon(int sides, double radius) {
  DataList corners;
  for (int n = 0; n < sides; ++n) {
    const Vec3 corner = on_circle(radius, 360.0 * n / sides);
    corners.emplace_back(DataList{Data(corner.x), Data(corner.y)});
  }
  return corners;
}

class Faceter {
 public:
  Faceter(const design::Node& round, int sides, const design::Registry& registry, const Reader& reader)
      : round_(round), sides_(sides), registry_(registry), reader_(reader) {}

  // Returns null if a length is a formula.
  NodePtr run() const {
    const std::string& name = round_.type().name;
    if (name == "cylinder") return prism(number("radius"), number("height"));
    if (name == "cone") return frustum(number("base"), number("top"), number("height"));
    return ball(number("radius"));
  }

 private:
  using Length = std::optional<double>;  // nothing if it is a formula

  NodePtr prism(Length radius, Length height) const {
    if (!radius || !height) return nullptr;
    return make("polygon_extrude", {{"vertices", polygon(sides_, *radius)}, {"height", *height}, {"symmetric", true}});
  }
  NodePtr frustum(Length base, Length top, Length height) const {
    if (!base || !top || !height) return nullptr;
    return make("hull", {{"points", frustum_points(sides_, *base, *top, *height)}});
  }
  NodePtr ball(Length radius) const {
    return radius ? make("hull", {{"points", ball_points(sides_, *radius)}}) : nullptr;
  }

  Length number(std::string_view parameter) const {
    const Data data = value(parameter);
    return data.number() ? Length(*data.number()) : std::nullopt;
  }

  Data value(std::string_view parameter) const {
    return round_.type().get(round_, static_cast<size_t>(round_.type().parameter(parameter)), false);
  }

  NodePtr make(std::string_view name, DataMembers arguments) const {
    const NodeType& type = *registry_.find(name);
    arguments.emplace_back("material", value("material"));
    std::vector<design::NamedValue> values;
    for (auto& [parameter, data] : arguments)
      values.push_back({&type.parameters[static_cast<size_t>(type.parameter(parameter))], std::move(data)});
    return design::make_node(type, values, {}, reader_);
  }

  const design::Node& round_;
  int sides_;
  const design::Registry& registry_;
  const Reader& reader_;
};

bool takes_facets(std::string_view name) { return name == "cylinder" || name == "cone" || name == "sphere"; }

}  // namespace

NodePtr with_facets(NodePtr round, const Invocation& call, const design::Registry& registry, const Reader& reader) {
  if (!call.wrong_facets.empty())
    reader.diagnostics.warning(reader.where, "$fn does nothing: it needs a number, found " + call.wrong_facets,
                               "write for example $fn=6");
  if (!round || !(call.facets > 0 && call.facets < least_round)) return round;
  const std::string& name = round->type().name;
  const int sides = std::max(3, static_cast<int>(call.facets));
  const auto warn = [&](const std::string& what, const Phrase& hint) {
    reader.diagnostics.warning(reader.where, "$fn=" + std::to_string(sides) + " does nothing to " + what, hint);
    return round;
  };
  if (takes_facets(name)) {
    if (NodePtr faceted = Faceter(*round, sides, registry, reader).run()) return faceted;
    return warn("a " + name + " of which a length is a formula: it stays round", "write its lengths as numbers");
  }
  const bool is_named = call.has_own_facets || name == "revolve";
  if (!is_named || std::ranges::find(always_round, name) == std::end(always_round)) return round;
  return warn(name + ", which stays round",
              "cylinder, cone and sphere take it; hull and polygon_extrude make other facets");
}

}  // namespace ombre::lang
