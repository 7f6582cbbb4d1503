#include "solids/roofs.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/math/math.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "solids/kernel.h"
#include "solids/regions.h"

namespace ombre::solids {
namespace {

// Rings with further corners, and for each corner the number of the point of the region at which it lies.
struct FineOutline {
  std::vector<Ring> rings;
  std::vector<uint32_t> point;
};

// The corner between two sides of a ring, with the inside on the left.
class Corner {
 public:
  Corner(const Ring& ring, size_t n)
      : at_(ring[n]), from_(at_ - ring[(n + ring.size() - 1) % ring.size()]), to_(ring[(n + 1) % ring.size()] - at_) {}

  // Returns the angle in radians by which the outline turns away from the inside; negative at outward corners.
  double inward_turn() const { return -std::atan2(cross(from_, to_), dot(from_, to_)); }

  // Appends corners of a minute outline around a circle in the outside, with sides that differ by equal angles.
  void append_round(int sides, Ring& ring) const {
    constexpr double part_of_side = 1e-4, most_mm = 1e-5;
    const double reach = std::min(most_mm, part_of_side * std::min(length(from_), length(to_)));
    const double turn = inward_turn(), step = turn / (sides + 1);
    const double radius = reach / std::tan(turn / 2);
    const Vec2 along = (1 / length(from_)) * from_;
    const Vec2 inward{-along.y, along.x};
    const Vec2 centre = at_ - reach * along - radius * inward;
    for (int n = 0; n <= sides; ++n) {
      const double angle = (n + 0.5) * step;  // from the normal of the first side
      const Vec2 direction = std::cos(angle) * inward + std::sin(angle) * along;
      ring.push_back(centre + (radius / std::cos(step / 2)) * direction);
    }
  }

 private:
  Vec2 at_, from_, to_;
};

// Rounds inward corners on a scale that nobody sees: the planes that rise from the sides of such a round touch the cone
// that rises from the corner.
FineOutline rounded(const Region& region, const Fragments& fragments) {
  FineOutline outline;
  const double step = fragments.count > 0 ? 360 / std::max(3.0, fragments.count) : std::max(0.01, fragments.angle);
  uint32_t number = 0;
  for (const Ring& ring : region.rings) {
    Ring& fine = outline.rings.emplace_back();
    for (size_t n = 0; n < ring.size(); ++n, ++number) {
      const Corner corner(ring, n);
      const size_t before = fine.size();
      const double steps = std::ceil(corner.inward_turn() / math::degree / step - 1e-9);
      if (steps > 1)
        corner.append_round(static_cast<int>(steps) - 1, fine);
      else
        fine.push_back(ring[n]);
      outline.point.insert(outline.point.end(), fine.size() - before, number);
    }
  }
  return outline;
}

FineOutline as_it_is(const Region& region) {
  FineOutline outline{region.rings, {}};
  for (const Ring& ring : region.rings)
    for (size_t n = 0; n < ring.size(); ++n) outline.point.push_back(static_cast<uint32_t>(outline.point.size()));
  return outline;
}

// True if each side of the rings is one of a triangle: a side on which another corner lies is cut, and of corners at
// the same place one counts.
bool are_apart(const std::vector<Ring>& rings, const PlaneTriangles& filling) {
  std::set<std::pair<uint32_t, uint32_t>> edges;
  for (const Triangle& t : filling.triangles)
    for (size_t n = 0; n < 3; ++n) edges.insert({t[n], t[(n + 1) % 3]});
  uint32_t first = 0;
  for (const Ring& ring : rings) {
    const auto size = static_cast<uint32_t>(ring.size());
    for (uint32_t n = 0; n < size; ++n)
      if (!edges.contains({first + n, first + (n + 1) % size})) return false;
    first += size;
  }
  return true;
}

TriangleMesh closed_roof(const Region& region, const PlaneTriangles& filling, const Roof& by) {
  const FineOutline outline = by.method == RoofMethod::straight ? as_it_is(region) : rounded(region, by.fragments);
  // The time of CGAL's skeletons grows with the square of the corners, and nothing stops them.
  constexpr size_t most_corners = 5000;
  if (outline.point.size() > most_corners)
    throw Error(Code::too_large, "a roof over " + format_count(outline.point.size()) +
                                     " corners takes too long; write fewer corners" +
                                     (by.method == RoofMethod::straight ? "" : ", or method = \"straight\""));
  TriangleMesh above = kernel().roof(outline.rings);
  TriangleMesh mesh;
  for (const Ring& ring : region.rings)
    for (const Vec2& p : ring) mesh.points.push_back({p.x, p.y, 0});
  const auto on_outline = static_cast<uint32_t>(mesh.points.size()),
             given = static_cast<uint32_t>(outline.point.size());
  mesh.points.insert(mesh.points.end(), above.points.begin() + given, above.points.end());
  const auto number = [&](uint32_t n) { return n < given ? outline.point[n] : n - given + on_outline; };
  for (const auto& [a, b, c] : above.triangles) mesh.triangles.push_back({number(a), number(b), number(c)});
  for (const auto& [a, b, c] : filling.triangles) mesh.triangles.push_back({a, c, b});
  return tidied(mesh);
}

}  // namespace

TriangleMesh roof_of(const Region& region, const Roof& by) {
  constexpr double gap_mm = 1e-6;  // between parts of an outline that touch
  PlaneTriangles filling = kernel().triangulate(region.rings);
  if (are_apart(region.rings, filling)) return closed_roof(region, filling, by);
  const Region parted = offset(region, Offset{-gap_mm / 2});
  filling = kernel().triangulate(parted.rings);
  if (!are_apart(parted.rings, filling))
    throw Error(Code::surface_crosses, "its outline touches itself; make a gap where it does");
  return closed_roof(parted, filling, by);
}

}  // namespace ombre::solids
