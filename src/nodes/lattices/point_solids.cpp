// Solids given by points in space.
#include <algorithm>

#include "base/math/curves.h"
#include "base/math/point_sets.h"
#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/repeated_points.h"
#include "nodes/common/shapes.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Hull {
  Points points;
  MaterialName material;
  std::vector<Plane> planes;  // computed when the node is made
  Vec3 middle;
  double depth = 0;  // distance from the middle to the nearest plane

  static Spec<Hull> spec() {
    return {"hull",
            "The convex hull of points: the smallest convex solid that contains all of them.",
            {{"points", &Hull::points, "At least four points, not all in one plane", required(unit::points)},
             {"material", &Hull::material, "Its material"}},
            no_inputs,
            "hull([[0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10], [6, 6, 6]], \"green\");"};
  }

  bool makes_nothing() const { return points.at.empty(); }

  bool complete(const Reader& reader) {
    OfPoints<Plane> found = hull_planes(points.at);
    if (!found.problem.empty()) return reader.refuse("points of hull: " + found.problem);
    planes = std::move(found.list);
    for (const Vec3& p : points.at) middle = middle + (1 / static_cast<double>(points.at.size())) * p;
    depth = Box::inf;
    for (const Plane& plane : planes) depth = std::min(depth, plane.offset - dot(plane.normal, middle));
    if (depth > 0) return true;
    return reader.refuse("points of hull: all points lie in one plane");
  }

  // Near edges and corners the surface is farther away than the planes.
  Metric metric() const { return Metric::bounded(); }

  // Planes moved outward by `margin` bound a hull that is larger by a factor below 1 + margin / depth, seen from the
  // middle.
  Box reach(const Inputs&, const Box&, double margin) const {
    const double larger = 1 + margin / depth;
    Box box;
    for (const Vec3& p : points.at) {
      const Vec3 corner = middle + larger * (p - middle);
      box = ombre::hull(box, Box{corner, corner});
    }
    return box.expanded(1e-9 * length(box.size()));
  }

  Field distance(const Point& p) const {
    std::vector<Field> beyond;
    for (const Plane& plane : planes)
      beyond.push_back(p.x * plane.normal.x + p.y * plane.normal.y + p.z * plane.normal.z - plane.offset);
    return program::fold(std::move(beyond), program::max);
  }
};

struct Tube {
  Points points;
  Number radius = 1;
  MaterialName material;
  Choice curve = "straight", caps = "round";
  bool closed = false;
  std::vector<Vec3> path;  // the points, or many points of the curve through them
  program::SourceField line;

  static Spec<Tube> spec() {
    return {"tube",
            "A round bar along lines, or along a smooth curve through points. Joints are round.",
            {{"points", &Tube::points, "At least two points on its centre line", required(unit::points)},
             {"radius", &Tube::radius, "Its radius", unit::positive_mm},
             {"material", &Tube::material, "Its material"},
             {"curve", &Tube::curve,
              "Centre line between points: straight, or smooth (a centripetal Catmull-Rom curve, accurate to 0.002 mm)",
              one_of({"straight", "smooth"})},
             {"caps", &Tube::caps,
              "Ends: round (half balls beyond the end points), or flat. A flat end also cuts off other parts of the "
              "tube that pass in front of it within a diameter",
              one_of({"round", "flat"})},
             {"closed", &Tube::closed, "Joins the last point to the first"}},
            no_inputs,
            "tube([[0, 0, 0], [10, 0, 0], [10, 8, 4], [0, 8, 8]], 1.2, \"cyan\", curve=\"smooth\");"};
  }

  bool makes_nothing() const { return points.at.empty(); }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("tubes cannot be made here");
    const std::vector<Vec3> corners = without_repeated(points.at, size_of(points.at), closed);
    const size_t least = closed ? 3 : 2;
    if (corners.size() < least)
      return reader.refuse(std::string(closed ? "a closed tube" : "a tube") + " needs at least " +
                           std::to_string(least) + " points, found " + std::to_string(corners.size()));
    path = curve == "smooth" ? smooth_path(corners) : corners;
    if (closed && curve != "smooth") path.push_back(corners.front());
    PathRequest request{path};
    line = reader.loader->source(request, reader);
    return line != nullptr;
  }

  // The surface behind a bend is farther away than the distance to the centre line suggests.
  Metric metric() const { return path.size() == 2 && caps == "round" ? Metric::exact() : Metric::bounded(); }

  Box bounds(const Box& where) const { return line->bounds().expanded(radius.range(where).hi); }

  Field distance(const Point& p) const {
    const int channel = line->channel("distance");
    ASSERT(channel >= 0);
    const Field r = radius(p), whole = p.builder().source(line, channel, p.x, p.y, p.z) - r;
    if (closed || caps == "round") return whole;
    const Field ends = max(before_end(p, r, path[0], path[1]), before_end(p, r, path.back(), path[path.size() - 2]));
    return max(whole, ends);
  }

 private:
  static constexpr double tolerance_mm = 0.002;

  // A ball around an end, twice as large as the tube, restricted to the side in front of the end's plane.
  static Field before_end(const Point& p, Field r, Vec3 end, Vec3 next) {
    const Vec3 n = (1 / length(end - next)) * (end - next);
    const Field x = p.x - end.x, y = p.y - end.y, z = p.z - end.z;
    return min(x * n.x + y * n.y + z * n.z, r * 2.0 - length(x, y, z));
  }

  // Returns the curve as a chain of Bézier curves, after Yuksel, Schaefer and Keyser, Parameterization and applications
  // of Catmull-Rom curves, 2011. An open curve is continued by reflection at its ends.
  std::vector<Vec3> smooth_path(const std::vector<Vec3>& corners) const {
    const size_t count = corners.size(), pieces = closed ? count : count - 1;
    const auto corner_at = [&](size_t n) {  // counted from the corner before the first
      if (closed) return corners[(n + count - 1) % count];
      if (n == 0) return 2.0 * corners[0] - corners[1];
      return n > count ? 2.0 * corners[count - 1] - corners[count - 2] : corners[n - 1];
    };
    std::vector<Vec3> chain{corners[0]};
    for (size_t n = 0; n < pieces; ++n)
      append_chords(piece(corner_at(n), corner_at(n + 1), corner_at(n + 2), corner_at(n + 3)), tolerance_mm, chain);
    return chain;
  }

  // Returns the piece between the second and the third of four points.
  static Cubic<Vec3> piece(Vec3 p0, Vec3 p1, Vec3 p2, Vec3 p3) {
    const double before = length(p1 - p0), here = length(p2 - p1), after = length(p3 - p2);
    const double a = std::sqrt(before), b = std::sqrt(here), c = std::sqrt(after);
    const Vec3 from = (1 / (3 * a * (a + b))) * (before * p2 - here * p0 + (2 * before + 3 * a * b + here) * p1);
    const Vec3 to = (1 / (3 * c * (c + b))) * (after * p1 - here * p3 + (2 * after + 3 * c * b + here) * p2);
    return {p1, from, to, p2};
  }
};

}  // namespace

void add_point_solids(Registry& registry) { registry.add<Hull, Tube>("point solids"); }

}  // namespace ombre::nodes
