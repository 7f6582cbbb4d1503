// Roofs over regions, from their straight skeletons.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/create_straight_skeleton_from_polygon_with_holes_2.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "base/text/error.h"
#include "solids/cgal/cgal_body.h"

namespace ombre::solids {
namespace {

using Quick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Outline = CGAL::Polygon_2<Quick>;
using Area = CGAL::Polygon_with_holes_2<Quick>;

Outline outline_of(const Ring& ring) {
  Outline outline;
  for (const Vec2& p : ring) outline.push_back({p.x, p.y});
  return outline;
}

// True if a hole, which does not cross the outline, lies within it.
bool holds(const Outline& outline, const Outline& hole) {
  const CGAL::Bbox_2 all = outline.bbox(), part = hole.bbox();
  if (part.xmin() < all.xmin() || part.xmax() > all.xmax() || part.ymin() < all.ymin() || part.ymax() > all.ymax())
    return false;
  return outline.bounded_side(hole[0]) == CGAL::ON_BOUNDED_SIDE;
}

// Returns each outline with its holes.
std::vector<Area> areas_of(std::span<const Ring> rings) {
  std::vector<Area> areas;
  for (const Ring& ring : rings)
    if (doubled_area(ring) > 0) areas.emplace_back(outline_of(ring));
  for (const Ring& ring : rings) {
    if (doubled_area(ring) >= 0) continue;
    const Outline hole = outline_of(ring);
    Area* own = nullptr;  // the smallest outline around it
    for (Area& area : areas)
      if (holds(area.outer_boundary(), hole) && (!own || holds(own->outer_boundary(), area.outer_boundary())))
        own = &area;
    if (own) own->add_hole(hole);
  }
  return areas;
}

// Collects the faces above areas. Ends of short edges count as one point, so that faces that meet in a point do so
// although the point is computed for each of them.
class RoofMaker {
 public:
  explicit RoofMaker(std::span<const Ring> rings) {
    for (const Ring& ring : rings)
      for (const Vec2& p : ring) {
        number_.emplace(std::pair(p.x, p.y), static_cast<uint32_t>(roof_.points.size()));
        roof_.points.push_back({p.x, p.y, 0});
        extent_ = std::max({extent_, std::abs(p.x), std::abs(p.y)});
      }
  }

  void add(const Area& area) {
    const auto skeleton = CGAL::create_interior_straight_skeleton_2(area);
    if (!skeleton) throw Error(Code::surface_crosses, "CGAL finds no straight skeleton of its outline");
    number_nodes(*skeleton);
    for (auto face = skeleton->faces_begin(); face != skeleton->faces_end(); ++face) {
      std::vector<uint32_t> corners;
      const auto first = face->halfedge();
      auto side = first;
      do corners.push_back(node_.at(side->vertex()->id()));
      while ((side = side->next()) != first);
      add_face(std::move(corners));
    }
  }

  TriangleMesh take() { return std::move(roof_); }

 private:
  template <class Skeleton>
  void number_nodes(const Skeleton& skeleton) {
    node_.clear();
    for (auto vertex = skeleton.vertices_begin(); vertex != skeleton.vertices_end(); ++vertex) {
      const double x = vertex->point().x(), y = vertex->point().y();
      if (vertex->is_contour()) {
        node_[vertex->id()] = number_.at({x, y});
        continue;
      }
      node_[vertex->id()] = static_cast<uint32_t>(roof_.points.size());
      roof_.points.push_back({x, y, vertex->time()});
    }
    std::map<uint32_t, uint32_t> same;
    const auto root = [&](uint32_t n) {
      for (auto at = same.find(n); at != same.end(); at = same.find(n)) n = at->second;
      return n;
    };
    for (auto side = skeleton.halfedges_begin(); side != skeleton.halfedges_end(); ++side) {
      if (!side->is_bisector()) continue;
      const uint32_t a = root(node_.at(side->vertex()->id())), b = root(node_.at(side->opposite()->vertex()->id()));
      const bool is_short = length(roof_.points[a] - roof_.points[b]) <= extent_ * shortest;
      if (a != b && is_short) same[std::max(a, b)] = std::min(a, b);
    }
    for (auto& [id, number] : node_) number = root(number);
  }

  void add_face(std::vector<uint32_t> corners) {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3) return;
    Ring ring;
    for (const uint32_t n : corners) ring.push_back({roof_.points[n].x, roof_.points[n].y});
    const PlaneTriangles cut = triangulate_rings({&ring, 1});
    const bool is_whole = cut.crossings.empty() && cut.triangles.size() == corners.size() - 2;
    for (const auto& [a, b, c] : is_whole ? cut.triangles : fan(corners.size()))
      roof_.triangles.push_back({corners[a], corners[b], corners[c]});
  }

  // Returns triangles of a face that is so narrow that rounding makes it cross itself.
  static std::vector<Triangle> fan(size_t corners) {
    std::vector<Triangle> triangles;
    for (uint32_t n = 2; n < corners; ++n) triangles.push_back({0, n - 1, n});
    return triangles;
  }

  static constexpr double shortest = 1e-9;  // in relation to the extent

  TriangleMesh roof_;
  std::map<std::pair<double, double>, uint32_t> number_;
  std::map<int, uint32_t> node_;  // numbers of points by the identity of vertices of a skeleton
  double extent_ = 0;
};

}  // namespace

TriangleMesh roof_over(std::span<const Ring> rings) {
  try {
    RoofMaker maker(rings);
    for (const Area& area : areas_of(rings)) maker.add(area);
    return maker.take();
  } catch (const std::logic_error& failure) {  // thrown by CGAL's checks
    throw Error(Code::surface_crosses,
                std::string("CGAL finds no straight skeleton of its outline: ") + failure.what());
  }
}

}  // namespace ombre::solids
