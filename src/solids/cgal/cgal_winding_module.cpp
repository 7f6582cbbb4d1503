// Mends surfaces that cross themselves: the solid of all points with a winding number other than 0.
//
// All triangles of one plane are triangulated together, with the lines where other triangles meet that plane. The new
// triangles do not cross, so the winding numbers on both sides of a patch of them are constant (Zhou, Grinspun, Zorin
// and Jacobson, Mesh Arrangements for Solid Geometry, 2016). The borders between 0 and other numbers are kept.
#include "solids/cgal/cgal_boxes.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>

#include "base/text/error.h"
#include "solids/cgal/cgal_body.h"

namespace ombre::solids {
namespace {

using Number = Exact::FT;
using Point = Exact::Point_3;
using Vector = Exact::Vector_3;
using Corners = std::array<Point, 3>;
// It remembers the lines that constraints came from, so that crossings of crossings are computed from few numbers.
using Triangulation = CGAL::Constrained_triangulation_plus_2<
    CGAL::Constrained_Delaunay_triangulation_2<Exact, CGAL::Default, CGAL::Exact_intersections_tag>>;
using Box3 = CGAL::Box_intersection_d::Box_with_info_d<double, 3, size_t>;

// The plane a x + b y + c z + d = 0 whose first coefficient other than 0 is 1, so that equal planes compare equal.
using PlaneNumbers = std::array<Number, 4>;

Number height(const PlaneNumbers& plane, const Point& p) {
  return plane[0] * p.x() + plane[1] * p.y() + plane[2] * p.z() + plane[3];
}

// Returns the plane of a triangle, and 1 or -1 if its normal has the triangle's direction or the opposite one.
std::pair<PlaneNumbers, int> plane_of(const Corners& t) {
  const Vector normal = CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  PlaneNumbers plane{normal.x(), normal.y(), normal.z(), -(normal * (t[0] - CGAL::ORIGIN))};
  const Number first = *std::find_if(plane.begin(), plane.end(), [](const Number& n) { return n != 0; });
  for (Number& n : plane) CGAL::exact(n /= first);
  return {plane, first > 0 ? 1 : -1};
}

// The triangles of one plane, and where others meet it.
struct Sheet {
  PlaneNumbers plane;
  std::vector<std::pair<size_t, int>> triangles;  // number, and 1 or -1 by its direction
  std::vector<std::pair<Point, Point>> lines;
  std::vector<Point> points;

  size_t dropped_axis() const {
    size_t axis = 0;
    for (size_t n = 1; n < 3; ++n)
      if (CGAL::abs(plane[n]) > CGAL::abs(plane[axis])) axis = n;
    return axis;
  }

  // Adds the segment or corner in which a triangle meets the plane.
  void add_crossing(const Corners& t) {
    std::array<Number, 3> heights;
    std::vector<Point> ends;
    for (size_t n = 0; n < 3; ++n) heights[n] = height(plane, t[n]);
    for (size_t n = 0; n < 3; ++n) {
      const size_t m = (n + 1) % 3;
      if (heights[n] == 0) ends.push_back(t[n]);
      if (heights[n] * heights[m] >= 0) continue;
      const Point crossing = t[n] + (t[m] - t[n]) * (heights[n] / (heights[n] - heights[m]));
      CGAL::exact(crossing);
      ends.push_back(crossing);
    }
    if (ends.size() == 1) points.push_back(ends[0]);
    if (ends.size() == 2) lines.emplace_back(ends[0], ends[1]);
  }
};

// A piece of a sheet: `winding` is the sum of the directions of the triangles that cover it, and not 0. The corners are
// counter-clockwise when seen from the side where the winding number is lower.
struct Facet {
  std::array<size_t, 3> corners;
  size_t sheet = 0;
  int winding = 0;
};

// The coordinates within a plane, without those of one axis, and back.
class Projection {
 public:
  explicit Projection(const Sheet& sheet) : plane_(sheet.plane), axis_(sheet.dropped_axis()) {}

  Exact::Point_2 operator()(const Point& p) const {
    return {p[static_cast<int>((axis_ + 1) % 3)], p[static_cast<int>((axis_ + 2) % 3)]};
  }
  Point lifted(const Exact::Point_2& p) const {
    const size_t u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    std::array<Number, 3> all;
    all[u] = p.x();
    all[v] = p.y();
    all[axis_] = -(plane_[u] * p.x() + plane_[v] * p.y() + plane_[3]) / plane_[axis_];
    const Point lifted(all[0], all[1], all[2]);
    CGAL::exact(lifted);
    return lifted;
  }
  // Returns true if counter-clockwise in the plane is clockwise when seen from where its normal points.
  bool mirrors() const { return plane_[axis_] < 0; }

 private:
  const PlaneNumbers& plane_;
  size_t axis_;
};

class Arrangement {
 public:
  explicit Arrangement(const TriangleMesh& mesh) {
    for (const Triangle& t : mesh.triangles) {
      Corners corners;
      for (size_t n = 0; n < 3; ++n) {
        const Vec3& p = mesh.points[t[n]];
        corners[n] = Point(p.x, p.y, p.z);
      }
      if (CGAL::collinear(corners[0], corners[1], corners[2])) continue;
      triangles_.push_back(std::move(corners));
      numbers_.push_back(t);
    }
    find_sheets();
    find_crossings();
    for (size_t n = 0; n < sheets_.size(); ++n) cut(n);
  }

  // Returns the surface of what the mesh winds around.
  ExactMesh borders() {
    std::vector<std::vector<std::size_t>> kept;
    for (const std::vector<size_t>& patch : patches()) {
      const int above = winding_above(facets_[patch[0]]), below = above + facets_[patch[0]].winding;
      if ((above != 0) == (below != 0)) continue;
      for (const size_t n : patch) {
        auto [a, b, c] = facets_[n].corners;
        if (above != 0) std::swap(b, c);
        kept.push_back({a, b, c});
      }
    }
    std::vector<Point> points = points_of(kept);
    return mesh_of_soup(std::move(points), std::move(kept));
  }

 private:
  void find_sheets() {
    std::map<PlaneNumbers, size_t> known;
    for (size_t n = 0; n < triangles_.size(); ++n) {
      auto [plane, direction] = plane_of(triangles_[n]);
      const auto [place, is_new] = known.try_emplace(std::move(plane), sheets_.size());
      if (is_new) sheets_.push_back({place->first, {}, {}, {}});
      sheets_[place->second].triangles.emplace_back(n, direction);
      sheet_of_.push_back(place->second);
    }
  }

  bool share_edge(size_t a, size_t b) const {
    int shared = 0;
    for (const uint32_t corner : numbers_[a]) shared += static_cast<int>(std::ranges::count(numbers_[b], corner));
    return shared > 1;
  }

  // Adds to each sheet where triangles of others meet the boxes of its own.
  void find_crossings() {
    std::vector<Box3> boxes;
    for (size_t n = 0; n < triangles_.size(); ++n)
      boxes.emplace_back(triangles_[n][0].bbox() + triangles_[n][1].bbox() + triangles_[n][2].bbox(), n);
    std::set<std::pair<size_t, size_t>> meetings;  // of a sheet and a triangle
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box3& one, const Box3& other) {
      const size_t a = one.info(), b = other.info();
      if (sheet_of_[a] == sheet_of_[b] || share_edge(a, b)) return;
      meetings.emplace(sheet_of_[a], b);
      meetings.emplace(sheet_of_[b], a);
    });
    for (const auto& [sheet, triangle] : meetings) sheets_[sheet].add_crossing(triangles_[triangle]);
  }

  static Triangulation triangulated(const Sheet& sheet, const Projection& flat, const std::vector<Corners>& triangles) {
    Triangulation result;
    const auto line = [&](const Point& from, const Point& to) { result.insert_constraint(flat(from), flat(to)); };
    for (const auto& [n, direction] : sheet.triangles)
      for (size_t k = 0; k < 3; ++k) line(triangles[n][k], triangles[n][(k + 1) % 3]);
    for (const auto& [from, to] : sheet.lines) line(from, to);
    for (const Point& p : sheet.points) result.insert(flat(p));
    return result;
  }

  // Returns the sum of the directions of a sheet's triangles around a point of it.
  int winding_in(const Sheet& sheet, const Projection& flat, const Exact::Point_2& p) const {
    int sum = 0;
    for (const auto& [n, direction] : sheet.triangles) {
      const Corners& t = triangles_[n];
      const std::array corners{flat(t[0]), flat(t[1]), flat(t[2])};
      const auto turn = CGAL::orientation(corners[0], corners[1], p);
      if (turn != CGAL::COLLINEAR && turn == CGAL::orientation(corners[1], corners[2], p) &&
          turn == CGAL::orientation(corners[2], corners[0], p))
        sum += direction;
    }
    return sum;
  }

  void cut(size_t number) {
    const Sheet& sheet = sheets_[number];
    const Projection flat(sheet);
    const Triangulation pieces = triangulated(sheet, flat, triangles_);
    std::map<Triangulation::Vertex_handle, size_t> numbers;
    const auto number_of = [&](Triangulation::Vertex_handle vertex) {
      const auto [place, is_new] = numbers.try_emplace(vertex, 0);
      if (is_new) place->second = numbered(flat.lifted(vertex->point()));
      return place->second;
    };
    for (auto face = pieces.finite_faces_begin(); face != pieces.finite_faces_end(); ++face) {
      const auto &a = face->vertex(0)->point(), &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
      const int winding = winding_in(sheet, flat, CGAL::centroid(a, b, c));
      if (winding == 0) continue;
      Facet facet{{number_of(face->vertex(0)), number_of(face->vertex(1)), number_of(face->vertex(2))},
                  number,
                  std::abs(winding)};
      if (flat.mirrors() != (winding < 0)) std::swap(facet.corners[1], facet.corners[2]);
      facets_.push_back(facet);
    }
  }

  size_t numbered(const Point& p) {
    const auto [place, is_new] = known_.try_emplace(p, points_.size());
    if (is_new) points_.push_back(p);
    return place->second;
  }

  // Returns the facets in groups that hang together at edges which no third facet shares.
  std::vector<std::vector<size_t>> patches() const {
    std::map<std::pair<size_t, size_t>, std::vector<size_t>> edges;
    for (size_t n = 0; n < facets_.size(); ++n)
      for (size_t k = 0; k < 3; ++k)
        edges[std::minmax(facets_[n].corners[k], facets_[n].corners[(k + 1) % 3])].push_back(n);
    std::vector<size_t> first(facets_.size());
    std::iota(first.begin(), first.end(), size_t{0});
    const auto root = [&](size_t n) {
      while (first[n] != n) n = first[n] = first[first[n]];
      return n;
    };
    for (const auto& [edge, users] : edges) {
      if (users.size() != 2) continue;
      const size_t a = root(users[0]), b = root(users[1]);
      first[std::max(a, b)] = std::min(a, b);
    }
    std::map<size_t, std::vector<size_t>> groups;
    for (size_t n = 0; n < facets_.size(); ++n) groups[root(n)].push_back(n);
    std::vector<std::vector<size_t>> result;
    for (auto& [ignored, group] : groups) result.push_back(std::move(group));
    return result;
  }

  // Returns the winding number just above a facet: the sum over all triangles that a ray from there leaves through.
  int winding_above(const Facet& facet) const {
    const Point &a = points_[facet.corners[0]], &b = points_[facet.corners[1]], &c = points_[facet.corners[2]];
    const Vector normal = CGAL::cross_product(b - a, c - a);
    const Point from = CGAL::centroid(a, b, c);
    CGAL::exact(from);
    std::minstd_rand random(1);  // fixed, so that the same surface gives the same directions
    const auto share = [&] { return static_cast<double>(random() % 1'000'003) / 1'000'003 - 0.5; };
    constexpr int most_directions = 1000;
    for (int n = 0; n < most_directions; ++n) {
      Vector direction(share(), share(), share());
      if (direction * normal < 0) direction = -direction;
      if (direction * normal == 0) continue;
      if (const auto sum = crossings(from, direction, facet.sheet)) return *sum;
    }
    throw Error(Code::surface_crosses, "no ray from it misses all of its edges");
  }

  // Null if the ray meets an edge.
  std::optional<int> crossings(const Point& from, const Vector& direction, size_t own_sheet) const {
    const Point to = from + direction;
    int sum = 0;
    for (size_t n = 0; n < triangles_.size(); ++n) {
      if (sheet_of_[n] == own_sheet) continue;
      const auto& [p, q, r] = triangles_[n];
      const auto first = CGAL::orientation(from, to, p, q), second = CGAL::orientation(from, to, q, r);
      if (first * second < 0) continue;
      const auto third = CGAL::orientation(from, to, r, p);
      if (first * third < 0 || second * third < 0) continue;
      if (first == 0 || second == 0 || third == 0) return std::nullopt;
      // The ray leaves through the triangle if it lies ahead and its normal points along the ray.
      const Vector normal = CGAL::cross_product(q - p, r - p);
      const auto along = CGAL::sign(normal * direction), ahead = CGAL::sign(normal * (p - from));
      if (along == ahead) sum += along;
    }
    return sum;
  }

  // Returns the points that the polygons use, and numbers them anew.
  std::vector<Point> points_of(std::vector<std::vector<std::size_t>>& polygons) const {
    std::map<size_t, size_t> place;
    std::vector<Point> used;
    for (auto& polygon : polygons)
      for (size_t& corner : polygon) {
        const auto [found, is_new] = place.try_emplace(corner, used.size());
        if (is_new) used.push_back(points_[corner]);
        corner = found->second;
      }
    return used;
  }

  std::vector<Corners> triangles_;
  std::vector<Triangle> numbers_;  // of their corners in the mesh
  std::vector<size_t> sheet_of_;
  std::vector<Sheet> sheets_;
  std::map<Point, size_t> known_;
  std::vector<Point> points_;
  std::vector<Facet> facets_;
};

}  // namespace

Parts wound_parts(const TriangleMesh& mesh) {
  Parts parts;
  for (ExactMesh& shell : apart(Arrangement(mesh).borders())) {
    if (touches_itself(shell))
      parts.push_back(touching_part(std::move(shell)));
    else
      parts.emplace_back(std::move(shell));
  }
  return parts;
}

}  // namespace ombre::solids
