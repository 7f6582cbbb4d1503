// Solids that are twisted, tapered and bent, and flat ones laid around cylinders and balls.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/math.h"
#include "base/text/text.h"
#include "nodes/common/parameter_checks.h"
#include "nodes/solids/warp.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Op;
using std::numbers::pi;

constexpr double infinite = std::numeric_limits<double>::infinity();

Field angle_of(Field y, Field x) { return x.builder->apply(Op::atan2, y, x); }

Box box_of(Interval x, Interval y, Interval z) {
  const Box box{{x.lo, y.lo, z.lo}, {x.hi, y.hi, z.hi}};
  return box.is_empty() ? Box::empty() : box;
}

Interval both(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }
bool is_none(Interval v) { return v.lo > v.hi; }
double greatest(Interval v) { return std::max(std::abs(v.lo), std::abs(v.hi)); }
double least(Interval v) { return v.lo <= 0 && v.hi >= 0 ? 0 : std::min(std::abs(v.lo), std::abs(v.hi)); }
double farthest_from_z_axis(const Box& box) { return std::hypot(greatest(box.axis(0)), greatest(box.axis(1))); }

// Returns the greatest factor by which [[a, 0, k], [0, a, 0], [0, 0, 1]] stretches a vector.
double shear_stretch(double a, double k) {
  const double sum = a * a + k * k + 1;
  return std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * a * a))) / 2);
}

struct Twist : Warp<Twist> {
  double rate = 0;

  static Spec<Twist> spec() {
    return {"twist",
            "Turns each cross section of its child about the z axis by an angle proportional to z.",
            {{"rate", &Twist::rate, "Angle per height, right-handed; nothing turns at z = 0", required(any("deg/mm"))}},
            one_solid,
            "twist(9) { rectprism((6, 6, 20), \"red\"); }"};
  }

  Point inner(const Point& p) const {
    const Field turn = p.z * (rate * math::degree);
    const Field c = cos(turn), s = sin(turn);
    return p.moved_to(p.x * c + p.y * s, p.y * c - p.x * s, p.z);
  }

  Box image_of(const Box& child) const {
    if (child.is_empty()) return child;
    const double r = farthest_from_z_axis(child);
    const Interval turn = math::multiply(rate * math::degree, child.axis(2)), c = math::cos(turn), s = math::sin(turn);
    const Interval x = math::subtract(math::multiply(child.axis(0), c), math::multiply(child.axis(1), s));
    const Interval y = math::add(math::multiply(child.axis(0), s), math::multiply(child.axis(1), c));
    return box_of(both(x, {-r, r}), both(y, {-r, r}), child.axis(2));
  }

  double stretch_in(const Box& box) const {
    return shear_stretch(1, std::abs(rate) * math::degree * farthest_from_z_axis(box));
  }
  void warn(const Reader&, const Box&) const {}
};

struct Taper : Warp<Taper> {
  double factor = 1, from_z = 0, to_z = 10;

  static Spec<Taper> spec() {
    return {"taper",
            "Widens or narrows its child along z, about the z axis.",
            {{"factor", &Taper::factor, "Factor of x and y at the height to_z and beyond", required(positive(""))},
             {"from_z", &Taper::from_z, "Height at which the child keeps its width, and beyond", unit::mm},
             {"to_z", &Taper::to_z, "Height at which the factor is reached; it changes linearly between the two",
              unit::mm}},
            one_solid,
            "taper(0.4, -8, 8) { cylinder(5, 16, \"red\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (from_z != to_z) return Warp::complete(reader, inputs);
    return reader.refuse(
        "from_z and to_z of taper are the same height",
        "write for example " + spelled::parameter("from_z", "0") + ", " + spelled::parameter("to_z", "20"));
  }

  Point inner(const Point& p) const {
    const Field share = min(max((p.z - from_z) / (to_z - from_z), 0.0), p.constant(1));
    const Field scale = share * (factor - 1) + 1.0;
    return p.moved_to(p.x / scale, p.y / scale, p.z);
  }

  Box image_of(const Box& child) const {
    if (child.is_empty()) return child;
    const Interval s = scale_in(child.axis(2));
    return box_of(math::multiply(child.axis(0), s), math::multiply(child.axis(1), s), child.axis(2));
  }

  double stretch_in(const Box& box) const {
    const double slope = std::abs((factor - 1) / (to_z - from_z)), narrow = scale_in(box.axis(2)).lo;
    return shear_stretch(1 / narrow, farthest_from_z_axis(box) * slope / (narrow * narrow));
  }
  void warn(const Reader&, const Box&) const {}

 private:
  Interval scale_in(Interval z) const {
    const auto at = [&](double height) {
      return 1 + (factor - 1) * std::clamp((height - from_z) / (to_z - from_z), 0.0, 1.0);
    };
    return {std::min(at(z.lo), at(z.hi)) * (1 - 1e-12), std::max(at(z.lo), at(z.hi)) * (1 + 1e-12)};
  }
};

// A part of an annulus: a range of angles around its beginning, and of radii. Angles beyond half a turn and radii below
// 0 are cut off.
struct Band {
  Interval angle, radius;

  Band(Interval along_mm, Interval radius_mm, double per_radian)
      : angle(both(math::multiply(1 / per_radian, along_mm), {-pi, pi})), radius(both(radius_mm, {0, infinite})) {}
  bool is_empty() const { return is_none(angle) || is_none(radius); }
};

// Returns the greatest stretch of rings of radius 1 that are evaluated at this radius, in a region that is at least
// `nearest` away from their centres.
double band_stretch(double radius, double nearest) { return nearest > 0 ? std::max(1.0, radius / nearest) : infinite; }

void warn_of_cut(const Reader& reader, bool is_cut, const std::string& what, const Phrase& hint) {
  if (is_cut) reader.diagnostics.warning(reader.where, std::string(reader.node) + " cuts off " + what, hint);
}

// Warns about parts that are cut off when they are laid around a radius.
void warn_of_band(const Reader& reader, const Box& child, double radius, Interval depth, const std::string& axis) {
  if (child.is_empty()) return;
  const double half_turn = pi * radius * (1 + 1e-9);
  const double length = std::max(-child.lo.x, child.hi.x);
  warn_of_cut(reader, length > half_turn && length < design_limit_mm,
              "what reaches further than half a turn, " + format_rounded(pi * radius) + " mm along x",
              "the child reaches " + format_rounded(length) + " mm; give it a radius of " +
                  format_rounded(length / pi) + " mm or more");
  warn_of_cut(reader, depth.hi > radius * (1 + 1e-9) && depth.hi < design_limit_mm,
              "what lies beyond the centre, " + format_rounded(radius) + " mm along " + axis,
              "the child reaches " + format_rounded(depth.hi) + " mm; give it a larger radius");
}

struct Bend : Warp<Bend> {
  double radius = 10;

  static Spec<Bend> spec() {
    return {"bend",
            "Bends its child in the xz plane: the x axis becomes a circle that begins at the origin.",
            {{"radius", &Bend::radius,
              "Radius of that circle, whose centre lies at z = radius; negative: below. Lengths at z = 0 do not change",
              required(unit::mm)}},
            one_solid,
            "bend(12) { rectprism((30, 6, 2), \"red\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) {
    if (radius != 0) return Warp::complete(reader, inputs);
    return reader.refuse(
        "the radius of bend is 0",
        "write for example " +
            spelled::either("bend(20), or bend(-20)", "\"radius\": 20, or -20", "bend(20), or bend(-20)") +
            " to bend downward");
  }

  Point inner(const Point& p) const {
    const double r = std::abs(radius);
    const Field rise = r - upward(p.z), from_centre = r - length(p.x, rise);
    return p.moved_to(angle_of(p.x, rise) * r, p.y, radius < 0 ? -from_centre : from_centre);
  }

  Box image_of(const Box& child) const {
    if (child.is_empty()) return child;
    const double r = std::abs(radius);
    const Band band(child.axis(0), math::subtract(r, upward(child.axis(2))), r);
    if (band.is_empty()) return Box::empty();
    const Interval z = math::subtract(r, math::multiply(band.radius, math::cos(band.angle)));
    return box_of(math::multiply(band.radius, math::sin(band.angle)), child.axis(1), upward(z));
  }

  double stretch_in(const Box& box) const {
    const Interval rise = math::subtract(std::abs(radius), upward(box.axis(2)));
    const bool meets_the_end = least(box.axis(0)) == 0 && rise.lo <= 0;
    return meets_the_end ? infinite : band_stretch(std::abs(radius), std::hypot(least(box.axis(0)), least(rise)));
  }

  void warn(const Reader& reader, const Box& child) const {
    warn_of_band(reader, child, std::abs(radius), upward(child.axis(2)), radius < 0 ? "-z" : "z");
  }

 private:
  Field upward(Field z) const { return radius < 0 ? -z : z; }
  Interval upward(Interval z) const { return radius < 0 ? math::negate(z) : z; }
};

struct Remap : Warp<Remap> {
  Choice to = "cylinder";
  double radius = 10;

  static Spec<Remap> spec() {
    return {
        "remap",
        "Lays a flat child around a cylinder along z, or a ball: its x goes around, its y upward, its z outward.",
        {{"to", &Remap::to,
          "cylinder; or sphere, with x the length along the equator and y the length from there to the poles",
          one_of({"cylinder", "sphere"})},
         {"radius", &Remap::radius, "Radius at which z = 0 lies; lengths do not change there", required(unit::radius)}},
        one_solid,
        "remap(radius=10) { rectprism((40, 8, 1), \"red\"); }"};
  }

  Point inner(const Point& p) const {
    const Field across = length(p.x, p.y), around = angle_of(p.y, p.x) * radius;
    if (to == "cylinder") return p.moved_to(around, p.z, across - radius);
    return p.moved_to(around, angle_of(p.z, across) * radius, length(p.x, p.y, p.z) - radius);
  }

  Box image_of(const Box& child) const {
    if (child.is_empty()) return child;
    const Band band(child.axis(0), math::add(child.axis(2), radius), radius);
    if (band.is_empty()) return Box::empty();
    Interval across = band.radius, z = child.axis(1);
    if (to == "sphere") {
      const Interval latitude = both(math::multiply(1 / radius, child.axis(1)), {-pi / 2, pi / 2});
      if (is_none(latitude)) return Box::empty();
      across = math::multiply(band.radius, math::cos(latitude));
      z = math::multiply(band.radius, math::sin(latitude));
    }
    return box_of(math::multiply(across, math::cos(band.angle)), math::multiply(across, math::sin(band.angle)), z);
  }

  double stretch_in(const Box& box) const {
    const bool meets_the_end = least(box.axis(1)) == 0 && box.lo.x <= 0;
    return meets_the_end ? infinite : band_stretch(radius, std::hypot(least(box.axis(0)), least(box.axis(1))));
  }

  void warn(const Reader& reader, const Box& child) const {
    warn_of_band(reader, child, radius, math::negate(child.axis(2)), "-z");
    const double quarter = pi / 2 * radius * (1 + 1e-9), up = greatest(child.axis(1));
    warn_of_cut(reader, to == "sphere" && !child.is_empty() && up > quarter && up < design_limit_mm,
                "what reaches beyond the poles, " + format_rounded(pi / 2 * radius) + " mm along y",
                "the child reaches " + format_rounded(up) + " mm");
  }
};

Box hull_of(const std::vector<Box>& boxes) {
  Box all;
  for (const Box& box : boxes) all = hull(all, box);
  return all;
}

// Halves boxes and drops those that `may_reach` excludes, as long as few are left.
template <class Condition>
Box searched(const Box& where, const Condition& may_reach) {
  constexpr size_t few = 64;
  constexpr double fine_enough_mm = 0.05;
  std::vector<Box> boxes;
  if (!where.is_empty() && may_reach(where)) boxes.push_back(where);
  while (!boxes.empty() && boxes.size() < few) {
    std::vector<Box> halves;
    for (const Box& box : boxes) {
      const Vec3 size = box.size();
      const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      if (size[axis] <= fine_enough_mm) return hull_of(boxes);
      Box low = box, high = box;
      low.hi[axis] = high.lo[axis] = box.center()[axis];
      for (const Box& half : {low, high})
        if (may_reach(half)) halves.push_back(half);
    }
    boxes = std::move(halves);
  }
  return hull_of(boxes);
}

// Thickens flat boxes, since transforms of the child could lose them to rounding. Boxes are flat where a formula is
// constant.
Box thickened(Box box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (box.lo[axis] != box.hi[axis]) continue;
    const double room = 1e-9 * (1 + std::abs(box.lo[axis]));
    box.lo[axis] -= room;
    box.hi[axis] += room;
  }
  return box;
}

struct FormulaWarp {
  Number x, y, z;
  std::optional<Vec3> min, max;

  static Spec<FormulaWarp> spec() {
    return {"warp",
            "Evaluates its child at another point, given by three formulas: at (x*2, y, z), it is half as wide.",
            {{"x", &FormulaWarp::x, "Coordinate x of the other point", required(unit::mm)},
             {"y", &FormulaWarp::y, "Coordinate y of the other point", required(unit::mm)},
             {"z", &FormulaWarp::z, "Coordinate z of the other point", required(unit::mm)},
             {"min", &FormulaWarp::min, "Least corner of a box to which it is cut; none: it is not cut", unit::point},
             {"max", &FormulaWarp::max, "Greatest corner of that box", unit::point}},
            one_solid,
            "warp(\"x - 1.5*sin(z/2)\", \"y\", \"z\") { cylinder(3, 20, \"red\"); }"};
  }

  bool complete(const Reader& reader) const { return is_box_or_none(reader, min, max); }

  Metric metric() const { return Metric::implicit(); }
  Point inner(const Point& p) const { return p.moved_to(x(p), y(p), z(p)); }

  Box reach(const Inputs& in, const Box& where, double margin) const {
    const Box box = min ? intersect(Box{*min, *max}.expanded(margin), where) : where;
    const Box child = in.reach(0, thickened(query_box(*this, box)), margin);
    return searched(box, [&](const Box& part) { return !intersect(query_box(*this, part), child).is_empty(); });
  }

  Field distance(const Inputs& in, const Point& p) const {
    const Field value = in.distance(0, inner(p));
    if (!min) return value;
    const Field box = from_box(p);
    return select(box <= 0, value, program::max(value, box));
  }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    const Field flag = in.membership(0, inner(p), border);
    return min ? logical_and(from_box(p) <= 0, flag) : flag;
  }

 private:
  Field from_box(const Point& p) const {
    const Vec3 c = 0.5 * (*min + *max), h = 0.5 * (*max - *min);
    return corner(abs(p.x - c.x) - h.x, abs(p.y - c.y) - h.y, abs(p.z - c.z) - h.z);
  }
};

}  // namespace

void add_warps(Registry& registry) { registry.add<Twist, Taper, Bend, Remap, FormulaWarp>("warps"); }

}  // namespace ombre::nodes
