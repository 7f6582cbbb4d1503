// Solids made from circles.
#include "design/spec.h"
#include "nodes/common/segments.h"
#include "nodes/common/shapes.h"
#include "nodes/common/strut_families.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Sphere {
  Number radius = 5;
  MaterialName material;

  static Spec<Sphere> spec() {
    return {"sphere",
            "A ball centred on the origin.",
            {{"radius", &Sphere::radius, "Its radius", unit::radius}, {"material", &Sphere::material, "Its material"}},
            no_inputs,
            "sphere(5, \"red\");"};
  }

  Box bounds(const Box& where) const {
    const double r = radius.range(where).hi;
    return Box::centered({r, r, r});
  }

  Traits traits() const { return grows_outward; }

  Field distance(const Point& p) const { return length(p.x, p.y, p.z) - radius(p); }
};

// An ellipsoid whose distance is a bound, since the exact distance requires an iteration.
struct Ellipsoid {
  Numbers3 radii{8, 5, 3};
  MaterialName material;

  static Spec<Ellipsoid> spec() {
    return {"ellipsoid",
            "A ball stretched along the axes, centred on the origin.",
            {{"radii", &Ellipsoid::radii, "Half lengths along x, y and z", unit::positive_mm},
             {"material", &Ellipsoid::material, "Its material"}},
            no_inputs,
            "ellipsoid((8, 5, 3), \"cyan\");"};
  }

  Metric metric() const { return radii.x == radii.y && radii.y == radii.z ? Metric::exact() : Metric::bounded(); }
  // The points with g <= margin form an ellipsoid that is larger by more than the margin along its long axes.
  Box reach(const Inputs&, const Box& where, double margin) const {
    const double least = std::min({radii.x.range(where).lo, radii.y.range(where).lo, radii.z.range(where).lo});
    if (margin > 0 && least <= 0) return where;
    return Box::centered((margin > 0 ? 1 + margin / least : 1) * radii.upper(where));
  }

  Traits traits() const { return grows_outward; }

  Field distance(const Point& p) const {
    const Field a = radii.x(p), b = radii.y(p), c = radii.z(p);
    return (length(p.x / a, p.y / b, p.z / c) - 1) * min(min(a, b), c);
  }
};

struct Cylinder {
  Number radius = 5, height = 10;
  MaterialName material;

  static Spec<Cylinder> spec() {
    return {"cylinder",
            "A cylinder along z, centred on the origin.",
            {{"radius", &Cylinder::radius, "Its radius", unit::radius},
             {"height", &Cylinder::height, "Its length along z", unit::positive_mm},
             {"material", &Cylinder::material, "Its material"}},
            no_inputs,
            "cylinder(4, 10, \"green\");"};
  }

  Box bounds(const Box& where) const {
    const double r = radius.range(where).hi;
    return Box::centered({r, r, height.range(where).hi / 2});
  }

  Traits traits() const { return grows_outward; }

  Field distance(const Point& p) const { return corner(length(p.x, p.y) - radius(p), abs(p.z) - height(p) * 0.5); }
};

struct Cone {
  Number base = 5, top = 0, height = 10;
  MaterialName material;

  static Spec<Cone> spec() {
    return {"cone",
            "A cone or frustum along z, centred on the origin, with its base down.",
            {{"base", &Cone::base, "Radius at the lower end", unit::radius_or_none},
             {"top", &Cone::top, "Radius at the upper end; 0: a point", unit::radius_or_none},
             {"height", &Cone::height, "Its length along z", unit::positive_mm},
             {"material", &Cone::material, "Its material"}},
            no_inputs,
            "cone(5, 2, 10, \"yellow\");"};
  }

  bool complete(const Reader& reader) const {
    if (!base.constant() || !top.constant() || *base.constant() + *top.constant() > 0) return true;
    return reader.refuse("a cone needs a radius greater than 0 at one of its ends");
  }

  Box bounds(const Box& where) const {
    const double r = std::max(base.range(where).hi, top.range(where).hi);
    return Box::centered({r, r, height.range(where).hi / 2});
  }

  // In the half plane (rho, z), the nearest point lies on a disc or on the slope.
  Field distance(const Point& p) const {
    const Field rho = length(p.x, p.y), low = base(p), high = top(p), half = height(p) * 0.5;
    const Field disc = select(p.z <= 0, low, high);
    const Field beyond_disc = max(rho - disc, 0.0), beyond_end = abs(p.z) - half;
    const Field run = high - low, rise = half * 2.0;
    const Field along =
        min(max(((rho - low) * run + (p.z + half) * rise) / (square(run) + square(rise)), 0.0), p.constant(1));
    const Field from_slope = rho - (low + run * along), above_slope = p.z - (rise * along - half);
    const Field nearest = sqrt(min(square(beyond_disc) + square(beyond_end), square(from_slope) + square(above_slope)));
    return select(logical_and(from_slope < 0, beyond_end < 0), -nearest, nearest);
  }
};

struct Torus {
  Number ring = 10, tube = 2;
  MaterialName material;

  static Spec<Torus> spec() {
    return {"torus",
            "A ring that lies flat in XY, centred on the origin.",
            {{"ring", &Torus::ring, "Radius of the centre line", unit::radius},
             {"tube", &Torus::tube, "Radius of the tube", unit::positive_mm},
             {"material", &Torus::material, "Its material"}},
            no_inputs,
            "torus(8, 2, \"magenta\");"};
  }

  // If the tube is wider than the ring, the hole closes and the inner half extends across the axis.
  Metric metric() const { return *tube.constant() <= *ring.constant() ? Metric::exact() : Metric::bounded(); }

  Box bounds(const Box& where) const {
    const double r = ring.range(where).hi, t = tube.range(where).hi;
    return Box::centered({r + t, r + t, t});
  }

  Field distance(const Point& p) const { return length(length(p.x, p.y) - ring(p), p.z) - tube(p); }
};

struct Strut {
  Vec3 start{0, 0, 0}, end{10, 0, 0};
  Number radius = 1;
  Choice caps = "flat";
  MaterialName material;

  static Spec<Strut> spec() {
    return {
        "strut",
        "A cylinder from one point to another.",
        {{"start", &Strut::start, "Centre of one end", unit::point},
         {"end", &Strut::end, "Centre of the other end", unit::point},
         {"radius", &Strut::radius, "Its radius; t runs from 0 at its start to 1 at its end",
          with_variables({"t"}, unit::positive_mm)},
         {"material", &Strut::material, "Its material"},
         {"caps", &Strut::caps, "Ends: flat, or round (half balls beyond the end points)", one_of({"flat", "round"})}},
        no_inputs,
        "strut((0, 0, 0), (10, 5, 3), 1, \"red\");",
        {{"along", &Strut::along, "Position along its axis, from 0 at its start to 1 at its end", Interval(0, 1)}}};
  }

  bool complete(const Reader& reader) const {
    if (length(end - start) > 0) return true;
    return reader.refuse("a strut needs two different end points");
  }

  Box bounds(const Box& where) const {
    return reach_of_segment(start, end, margins(direction(), radius.range(where, {{"t", {0, 1}}}).hi), where);
  }

  Field distance(const Point& p) const {
    const Vec3 u = direction(), middle = 0.5 * (start + end);
    const double half = length(end - start) / 2;
    const Field x = p.x - middle.x, y = p.y - middle.y, z = p.z - middle.z;
    const Field along = from_middle(p);
    if (caps == "round") {
      const Field t = min(max(along, -half), p.constant(half));
      return length(x - t * u.x, y - t * u.y, z - t * u.z) - radius_at(p);
    }
    const Field across = length(x - along * u.x, y - along * u.y, z - along * u.z);
    return corner(across - radius_at(p), abs(along) - half);
  }

  Field along(const Ask& ask) const { return share(ask.p); }

  // Returns the strut, or why it is not a conical frustum.
  StrutsOrReason beam() const {
    const auto [radii, reason] = end_radii(radius);
    if (!radii) return {{}, reason};
    return {NodeStruts{{{start, end, (*radii)[0], (*radii)[1], caps == "flat"}}}};
  }

 private:
  Vec3 direction() const { return (1 / length(end - start)) * (end - start); }

  // Returns the position along the axis in mm, measured from the midpoint.
  Field from_middle(const Point& p) const {
    const Vec3 u = direction(), middle = 0.5 * (start + end);
    return (p.x - middle.x) * u.x + (p.y - middle.y) * u.y + (p.z - middle.z) * u.z;
  }

  // Returns the position from 0 at the start to 1 at the end. It uses values that the distance needs, too.
  Field share(const Point& p) const {
    return min(max(from_middle(p) * (1 / length(end - start)) + 0.5, 0.0), p.constant(1));
  }

  Field radius_at(const Point& p) const {
    return radius.at(p, [&](std::string_view name) -> std::optional<Field> {
      if (name != "t") return std::nullopt;
      return share(p);
    });
  }

  // Returns the greatest extent of the surface from the axis along x, y and z.
  Vec3 margins(Vec3 u, double r) const {
    if (caps == "round") return {r, r, r};
    const auto side = [r](double cosine) {
      const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
      return sine == 0 ? 0 : r * sine * (1 + 1e-12);
    };
    return {side(u.x), side(u.y), side(u.z)};
  }
};

}  // namespace

std::optional<StrutMaker> single_strut(const design::Node& node) {
  const auto* strut = dynamic_cast<const NodeOf<Strut>*>(&node);
  if (!strut) return std::nullopt;
  return StrutMaker{1, [strut] { return strut->data.beam(); }};
}

void add_round_solids(Registry& registry) {
  registry.add<Sphere, Ellipsoid, Cylinder, Cone, Torus, Strut>("round solids");
}

}  // namespace ombre::nodes
