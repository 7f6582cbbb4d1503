// Solids that are laid along the surfaces of others.
#include <algorithm>
#include <cmath>

#include "design/spec.h"
#include "nodes/common/child_distance.h"
#include "nodes/common/parameter_checks.h"
#include "nodes/common/shapes.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Op;

// The inputs are a base and a pattern. In scripts each is made by one statement.
constexpr InputInfo two_solids{2, 2, true};

// Step to both sides for the differences that give normals of the base. It is finer than voxels, and coarse enough for
// single precision.
constexpr double normal_step_mm = 0.01;

// The inputs are two surfaces and a child that stands on the first.
constexpr InputInfo three_solids{3, 3, true};

Field difference(const Inputs& in, size_t solid, const Point& p, Vec3 step) {
  return in.distance(solid, p.mapped(Affine::translation(step))) -
         in.distance(solid, p.mapped(Affine::translation(-step)));
}

// Moves `from` by `way` along the normal of a solid's distance at p.
Point along_normal(const Inputs& in, size_t solid, const Point& p, const Point& from, Field way) {
  const Field x = difference(in, solid, p, {normal_step_mm, 0, 0}),
              y = difference(in, solid, p, {0, normal_step_mm, 0}),
              z = difference(in, solid, p, {0, 0, normal_step_mm});
  const Field size = max(length(x, y, z), 1e-9 * normal_step_mm);
  // Intervals cannot bound the quotients, so components of the normal are clamped to its length of one.
  const auto part = [&](Field v) { return min(max(v / size, -1.0), p.constant(1)); };
  return from.moved_to(from.x + way * part(x), from.y + way * part(y), from.z + way * part(z));
}

// Returns the nearest point of a solid's surface, given the distance at p.
Point on_surface(const Inputs& in, size_t solid, const Point& p, Field distance) {
  return along_normal(in, solid, p, p, -distance);
}

// A solid whose points have what the input of that number has at their places.
template <class Map, size_t laid>
struct Laid {
  Composition composition(const Inputs& in, const Point& p, Demand demand) const {
    return in.composition(laid, place_of(in, p), demand);
  }
  Field attribute(const Inputs& in, std::string_view name, const Point& p, Demand demand) const {
    return in.attribute(laid, name, place_of(in, p), demand);
  }
  Numbers4 passed(const Inputs& in, std::string_view output, const Point& p) const {
    return in.output(laid, output, place_of(in, p));
  }

 private:
  Point place_of(const Inputs& in, const Point& p) const { return static_cast<const Map&>(*this).place(in, p); }
};

// Maps a pattern onto a surface. The pattern's x and y are the position on the surface, and its z is the height above
// it. The position is that of the surface's nearest point q, in a frame whose third axis is `direction`:
// - planar: the first two coordinates of q.
// - cylindrical: the arc around the third axis up to q, and q's third coordinate.
// - spherical: arcs on the sphere around `around` through q, along its equator and from there to q.
struct ConformalMap : Laid<ConformalMap, 1> {
  Choice mapping = "planar";
  Vec3 direction{0, 0, 1}, around;

  static Spec<ConformalMap> spec() {
    return {"conformal_map",
            "Lays a flat pattern, its second child, along the surface of its first child. The pattern's z is the "
            "height above the surface; its x and y are a place on it.",
            {{"mapping", &ConformalMap::mapping,
              "Meaning of x and y: planar (as seen along ref_dir), cylindrical (lengths around ref_dir and along it), "
              "or spherical (lengths around ref_dir and from the equator to the poles)",
              one_of({"planar", "cylindrical", "spherical"})},
             {"ref_dir", &ConformalMap::direction,
              "Reference direction; the pattern's x begins along x, or along y if ref_dir is x", unit::direction},
             {"around", &ConformalMap::around, "Point where x, y and ref_dir begin", unit::point}},
            two_solids,
            "conformal_map(mapping=\"cylindrical\") { cylinder(10, 20); rectprism((30, 6, 2), \"red\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) const {
    warn_of_implicit_distance(reader, *inputs[0], "conformal_map");
    return has_direction(reader, "ref_dir", direction);
  }

  Metric metric() const { return Metric::implicit(); }
  // The base is evaluated at the point, and twice along each axis.
  Traits traits() const { return {.most_evaluations_of_input = 7}; }

  Field distance(const Inputs& in, const Point& p) const { return in.distance(1, place(in, p)); }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    return in.membership(1, place(in, p), border);
  }

  // Returns where the pattern can reach. Points lie at most the pattern's height above the base, and no farther than
  // that from their positions on the surface.
  Box reach(const Inputs& in, const Box& where, double margin) const {
    const Box pattern = in.reach(1, design_space(), margin);
    if (pattern.is_empty()) return pattern;
    const Box box = in.reach(0, where, std::max(0.0, pattern.hi.z));
    const double farthest = std::max(std::abs(pattern.lo.z), std::abs(pattern.hi.z)) * (1 + 1e-9);
    Box places = Box::centered({design_limit_mm, design_limit_mm, design_limit_mm});
    if (mapping == "planar") {
      places = {{pattern.lo.x, pattern.lo.y, -design_limit_mm}, {pattern.hi.x, pattern.hi.y, design_limit_mm}};
    } else if (mapping == "cylindrical") {
      places.lo.z = pattern.lo.y;
      places.hi.z = pattern.hi.y;
    }
    return intersect(box, image(inverse(frame()), places.expanded(farthest)));
  }

  // Returns the point at which the pattern is evaluated.
  Point place(const Inputs& in, const Point& p) const {
    const Field height = in.distance(0, p);
    const Point q = on_surface(in, 0, p, height).mapped(frame());
    if (mapping == "planar") return q.moved_to(q.x, q.y, height);
    const auto angle = [&](Field y, Field x) { return p.builder().apply(Op::atan2, y, x); };
    const Field across = length(q.x, q.y), around_axis = angle(q.y, q.x);
    if (mapping == "cylindrical") return q.moved_to(around_axis * across, q.z, height);
    const Field radius = length(q.x, q.y, q.z);
    return q.moved_to(around_axis * radius, angle(q.z, across) * radius, height);
  }

 private:
  // Returns the map from points to the frame of positions.
  Affine frame() const { return turned_to_z(direction) * Affine::translation(-around); }
};

// Maps a child from one surface to another. For a point p at height h above the second surface, q is the nearest point
// of that surface. The child is evaluated at height h above the point of the first surface that is nearest to q.
struct SurfaceMap : Laid<SurfaceMap, 2> {
  double height = 10;

  static Spec<SurfaceMap> spec() {
    return {
        "surface_map",
        "Moves its third child from the surface of its first child to that of its second, keeping heights above the "
        "surface.",
        {{"height", &SurfaceMap::height, "Greatest height above and below the surfaces; anything farther is cut off",
          required(unit::positive_mm)}},
        three_solids,
        "surface_map(height=3) { sphere(8); ellipsoid((12, 9, 7)); translate(8, 0, 0) cube(2, \"red\"); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) const {
    for (size_t i = 0; i < 2; ++i) warn_of_implicit_distance(reader, *inputs[i], "surface_map");
    return true;
  }

  Metric metric() const { return Metric::implicit(); }
  // Each surface is evaluated at a point, and twice along each axis, for two points.
  Traits traits() const { return {.most_evaluations_of_input = 14}; }

  Field distance(const Inputs& in, const Point& p) const {
    return max(in.distance(2, place(in, p)), abs(in.distance(1, p)) - height);
  }
  Field membership(const Inputs& in, const Point& p, Border border) const {
    return logical_and(in.membership(2, place(in, p), border),
                       at_most(abs(in.distance(1, p)), p.constant(height), border));
  }

  Box reach(const Inputs& in, const Box& where, double margin) const { return in.reach(1, where, height + margin); }

  // Returns the point at which the child is evaluated.
  static Point place(const Inputs& in, const Point& p) {
    const Field h = in.distance(1, p);
    const Point there = on_surface(in, 1, p, h), here = on_surface(in, 0, there, in.distance(0, there));
    return along_normal(in, 0, here, here, h);
  }
};

}  // namespace

void add_maps(Registry& registry) { registry.add<ConformalMap, SurfaceMap>("maps"); }

}  // namespace ombre::nodes
