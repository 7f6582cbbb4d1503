#include "base/math/voronoi_cells.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/math/math.h"

namespace ombre {
namespace {

using Tetrahedron = std::array<size_t, 4>;

// Returns the centre of the sphere through the corners, or nothing if they lie in a plane.
std::optional<Vec3> centre_of(std::span<const Vec3> points, const Tetrahedron& t) {
  constexpr double flat = 1e-12;  // share of the volume of a cube on its longest edge
  const Vec3 p = points[t[0]], a = points[t[1]] - p, b = points[t[2]] - p, c = points[t[3]] - p;
  const double volume = dot(a, cross(b, c)), longest = std::max({length(a), length(b), length(c)});
  if (!(std::abs(volume) > flat * longest * longest * longest)) return std::nullopt;
  return p + (0.5 / volume) * (dot(a, a) * cross(b, c) + dot(b, b) * cross(c, a) + dot(c, c) * cross(a, b));
}

// The face between two cells: the centres of the tetrahedra around the edge from point to point.
class Face {
 public:
  void add(Vec3 corner) { corners_.push_back(corner); }

  // Puts the corners in order around the direction `across` of the edge, each once.
  void arrange(Vec3 across) {
    Vec3 middle;
    for (const Vec3 corner : corners_) middle = middle + (1 / static_cast<double>(corners_.size())) * corner;
    const Vec3 n = (1 / length(across)) * across;
    const Vec3 aside = std::abs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = (1 / length(cross(n, aside))) * cross(n, aside), y = cross(n, x);
    std::ranges::sort(corners_, {}, [&](Vec3 p) { return math::atan2(dot(p - middle, y), dot(p - middle, x)); });
    const double same = 1e-9 * length(across);
    const auto is_same = [&](Vec3 a, Vec3 b) { return length(a - b) < same; };
    corners_.erase(std::unique(corners_.begin(), corners_.end(), is_same), corners_.end());
    if (corners_.size() > 1 && length(corners_.front() - corners_.back()) < same) corners_.pop_back();
  }
  double area() const {
    Vec3 sum;
    for (size_t n = 2; n < corners_.size(); ++n)
      sum = sum + 0.5 * cross(corners_[n - 1] - corners_[0], corners_[n] - corners_[0]);
    return length(sum);
  }
  double perimeter() const {
    double sum = 0;
    for (size_t n = 0; n < corners_.size(); ++n) sum += length(corners_[n] - corners_[(n + 1) % corners_.size()]);
    return sum;
  }
  bool has_area() const { return corners_.size() > 2; }
  const std::vector<Vec3>& corners() const { return corners_; }

 private:
  std::vector<Vec3> corners_;
};

// Returns the points on the convex hull: those of faces of one tetrahedron alone.
std::vector<bool> points_on_hull(size_t count, const std::vector<Tetrahedron>& all) {
  std::map<std::array<size_t, 3>, int> faces;
  for (const Tetrahedron& t : all)
    for (size_t n = 0; n < 4; ++n) {
      std::array<size_t, 3> face{t[(n + 1) % 4], t[(n + 2) % 4], t[(n + 3) % 4]};
      std::ranges::sort(face);
      ++faces[face];
    }
  std::vector<bool> is_outer(count);
  for (const auto& [face, times] : faces)
    if (times == 1)
      for (const size_t point : face) is_outer[point] = true;
  return is_outer;
}

}  // namespace

OfPoints<VoronoiCell> voronoi_cells(std::span<const Vec3> points) {
  const OfPoints<Tetrahedron> tetrahedra = delaunay_tetrahedra(points);
  if (!tetrahedra.problem.empty()) return {{}, tetrahedra.problem};
  const std::vector<bool> is_outer = points_on_hull(points.size(), tetrahedra.list);
  std::map<std::array<size_t, 2>, Face> faces;
  for (const Tetrahedron& t : tetrahedra.list) {
    const auto centre = centre_of(points, t);
    if (!centre) continue;
    for (size_t i = 0; i < 4; ++i)
      for (size_t j = i + 1; j < 4; ++j) faces[{t[i], t[j]}].add(*centre);
  }
  OfPoints<VoronoiCell> cells;
  cells.list.resize(points.size());
  std::vector<bool> is_beside_outer = is_outer;
  for (auto& [pair, face] : faces) {
    const Vec3 way = points[pair[1]] - points[pair[0]];
    face.arrange(way);
    if (!face.has_area()) continue;
    if (is_outer[pair[0]] || is_outer[pair[1]]) is_beside_outer[pair[0]] = is_beside_outer[pair[1]] = true;
    for (const size_t point : pair) {
      VoronoiCell& cell = cells.list[point];
      cell.volume_mm3 += face.area() * length(way) / 6;  // a pyramid, whose tip is the point
      cell.edges_mm += face.perimeter() / 2;             // each edge lies in two faces
      ++cell.faces;
      cell.edges += face.corners().size();
      for (const Vec3 corner : face.corners()) cell.box = hull(cell.box, Box{corner, corner});
    }
  }
  for (size_t n = 0; n < points.size(); ++n) {
    VoronoiCell& cell = cells.list[n];
    if (is_outer[n] || cell.faces == 0) {
      cell = {};
      continue;
    }
    cell.is_bounded = true;
    cell.is_inner = !is_beside_outer[n];
    cell.edges /= 2;  // each was counted in two faces
  }
  return cells;
}

}  // namespace ombre
