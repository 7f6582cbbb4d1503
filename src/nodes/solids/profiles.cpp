// Solids from profiles: extruded and revolved polygons.
#include <algorithm>
#include <numbers>

#include "base/math/math.h"
#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/repeated_points.h"
#include "nodes/common/shapes.h"
#include "nodes/solids/plane_polygons.h"

namespace ombre::nodes {
namespace {

using namespace design;

Field ask(const program::SourceField& source, const char* channel, Field x, Field y) {
  const int number = source->channel(channel);
  ASSERT(number >= 0);
  return x.builder->source(source, number, x, y, x.builder->constant(0));
}

struct PolygonExtrude {
  Points vertices;
  double height = 5;
  bool symmetric = false;
  MaterialName material;
  std::vector<Points> holes;
  double taper = 0;
  Affine here_from_plane;
  program::SourceField outline;  // made with the node

  static Spec<PolygonExtrude> spec() {
    return {"polygon_extrude",
            "An extruded polygon. Points of two numbers lie in XY and are extruded along z; points of three numbers "
            "are extruded along the normal around which they go counterclockwise.",
            {{"vertices", &PolygonExtrude::vertices,
              "Its corners in order: [x, y] in the plane XY, or [x, y, z], all in one plane; if it crosses itself, all "
              "enclosed areas are inside",
              required(unit::points)},
             {"height", &PolygonExtrude::height, "Height above its plane", unit::positive_mm},
             {"symmetric", &PolygonExtrude::symmetric, "Extends by half of the height to each side of the plane"},
             {"material", &PolygonExtrude::material, "Its material"},
             {"holes", &PolygonExtrude::holes, "Polygons that are cut out, in the same plane", unit::points},
             {"taper", &PolygonExtrude::taper,
              "Angle by which its walls lean inward, away from the plane of the points; below 0: outward",
              from_to(-80, 80, "deg")}},
            no_inputs,
            "polygon_extrude([[0, 0], [12, 0], [12, 4], [4, 4], [4, 10], [0, 10]], 5, false, \"red\");"};
  }

  bool makes_nothing() const { return vertices.at.empty(); }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("polygons cannot be read here");
    auto plane = PlanePolygons::read(vertices, holes, reader);
    if (!plane) return false;
    here_from_plane = plane->here_from_plane;
    PolygonsRequest request{std::move(plane->polygons), false};
    outline = reader.loader->source(request, reader);
    return outline != nullptr;
  }

  Metric metric() const { return taper == 0 ? Metric::exact() : Metric::bounded(); }

  Box reach(const Inputs&, const Box&, double margin) const {
    const double rise = symmetric ? height / 2 : height;
    const double side = margin / cosine() + std::max(0.0, -tangent()) * (rise + margin);
    Box box = outline->bounds().expanded(side);
    box.lo.z = (symmetric ? -rise : 0) - margin;
    box.hi.z = rise + margin;
    return image(here_from_plane, box).expanded(1e-12 * (length(box.size()) + length(here_from_plane.offset)));
  }

  // With tapered walls, the offset of the polygon grows with the distance from its plane.
  Field distance(const Point& p) const {
    const Point at = p.mapped(inverse(here_from_plane));
    const Field flat = ask(outline, "distance", at.x, at.y), beyond = beyond_ends(at.z);
    if (taper == 0) return corner(flat, beyond);
    return max((flat + abs(at.z) * tangent()) * cosine(), beyond);
  }

  // Does not need distances, which makes it fast along rows of voxels.
  Field membership(const Inputs&, const Point& p, Border border) const {
    if (taper != 0) return at_most(distance(p), 0, border);
    const Point at = p.mapped(inverse(here_from_plane));
    return logical_and(truth(ask(outline, "inside", at.x, at.y)), at_most(beyond_ends(at.z), 0, border));
  }

 private:
  double tangent() const { return math::tan(taper / 180 * std::numbers::pi); }
  double cosine() const { return math::cos(taper / 180 * std::numbers::pi); }
  Field beyond_ends(Field z) const { return symmetric ? abs(z) - height / 2 : abs(z - height / 2) - height / 2; }
};

struct Revolve {
  Points profile;
  double angle = 360;
  MaterialName material;
  program::SourceField outline;  // made with the node; x is rho and y is z

  static Spec<Revolve> spec() {
    return {"revolve",
            "A polygon revolved about the z axis, right-handed from +x.",
            {{"profile", &Revolve::profile,
              "Its corners in order: [rho, z], with rho the distance from the axis; if it crosses itself, all enclosed "
              "areas are inside",
              required(in_space(InSpace::profile, unit::points))},
             {"angle", &Revolve::angle, "Angle of the revolution", turns()},
             {"material", &Revolve::material, "Its material"}},
            no_inputs,
            "revolve([[3, 0], [8, 0], [8, 2], [5, 4], [5, 10], [3, 10]], 270, \"blue\");"};
  }

  bool makes_nothing() const { return profile.at.empty(); }

  bool complete(const Reader& reader) {
    if (!reader.loader) return reader.refuse("polygons cannot be read here");
    Ring ring;
    const double on_axis = noise_of_points * size_of(profile.at);
    for (size_t n = 0; n < profile.at.size(); ++n) {
      Vec3 p = profile.at[n];
      if (std::abs(p.x) <= on_axis) p.x = 0;
      if (!profile.are_flat || p.x < 0)
        return reader.refuse("point " + std::to_string(n + 1) + " of revolve " +
                                 (profile.are_flat ? "lies beyond the axis: its rho is below 0" : "has three numbers"),
                             "write [rho, z] for each point, with rho of at least 0");
      ring.push_back({p.x, p.y});
    }
    const auto checked = checked_ring(std::move(ring), "revolve", reader);
    if (!checked) return false;
    PolygonsRequest request{{{*checked}, {}}, true};
    outline = reader.loader->source(request, reader);
    return outline != nullptr;
  }

  Box bounds(const Box&) const {
    const Box flat = outline->bounds();
    Box box;
    const auto add = [&](double degrees) {
      const Vec3 ray = Affine::rotation({0, 0, 1}, degrees)({1, 0, 0});
      for (const double rho : {flat.lo.x, flat.hi.x}) {
        const Vec3 p = rho * ray;
        box = hull(box, Box{{p.x, p.y, flat.lo.y}, {p.x, p.y, flat.hi.y}});
      }
    };
    for (int quarter = 0; quarter * 90 < angle; ++quarter) add(quarter * 90);
    add(angle);
    return box.expanded(1e-12 * flat.hi.x);
  }

  Field distance(const Point& p) const {
    const Field rho = length(p.x, p.y), ring = ask(outline, "distance", rho, p.z);
    if (angle == 360) return ring;
    const Field within = select(ring < 0, max(ring, -min(from_end_plane(p, 0), from_end_plane(p, angle))), ring);
    return select(faces(p, false), within, min(from_end(p, 0), from_end(p, angle)));
  }

  Field membership(const Inputs&, const Point& p, Border border) const {
    const Field ring = truth(ask(outline, "inside", length(p.x, p.y), p.z));
    return angle == 360 ? ring : logical_and(ring, faces(p, border == Border::excluded));
  }

 private:
  static Domain turns() {
    Domain domain = positive("deg");
    domain.greatest = 360;
    return domain;
  }

  // Coordinates of a point relative to an end face: `along` the face, and `across` it, forward.
  struct End {
    Field along, across;
  };
  static End end_at(const Point& p, double degrees) {
    const Vec3 u = Affine::rotation({0, 0, 1}, degrees)({1, 0, 0});
    return {p.x * u.x + p.y * u.y, p.y * u.x - p.x * u.y};
  }

  // Returns the distance to the half plane that starts at the axis and contains an end face.
  static Field from_end_plane(const Point& p, double degrees) {
    const End end = end_at(p, degrees);
    return length(min(end.along, p.constant(0)), end.across);
  }

  // Returns the distance to the end face.
  Field from_end(const Point& p, double degrees) const {
    const End end = end_at(p, degrees);
    return length(max(ask(outline, "distance", end.along, p.z), 0.0), end.across);
  }

  // True if the point lies between the end faces, seen from the axis.
  Field faces(const Point& p, bool strictly) const {
    const auto not_below = [&](Field value) { return strictly ? 0.0 - value < 0 : 0.0 - value <= 0; };
    const Field behind_first = not_below(end_at(p, 0).across), before_last = not_below(-end_at(p, angle).across);
    return angle <= 180 ? logical_and(behind_first, before_last) : logical_or(behind_first, before_last);
  }
};

}  // namespace

void add_profiles(Registry& registry) { registry.add<PolygonExtrude, Revolve>("profiles"); }

}  // namespace ombre::nodes
