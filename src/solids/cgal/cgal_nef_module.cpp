// Nef polyhedra: booleans for surfaces that touch themselves, and convex decomposition.
#include "solids/cgal/cgal_boxes.h"

#include <CGAL/Nef_nary_union_3.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/convex_decomposition_3.h>

#include <algorithm>
#include <numeric>

#include "base/text/error.h"
#include "solids/cgal/cgal_body.h"

namespace ombre::solids {

using Nef = CGAL::Nef_polyhedron_3<Exact>;

class NefSolid {
 public:
  explicit NefSolid(Nef solid) : solid_(std::move(solid)) {}
  const Nef& solid() const { return solid_; }

 private:
  Nef solid_;
};

namespace {

// Returns what a shell encloses. Where it touches itself, CGAL needs its triangles one by one.
Nef nef_of_shell(const ExactMesh& shell) {
  if (!touches_itself(shell)) return Nef(ExactMesh(shell));
  CGAL::Nef_nary_union_3<Nef> triangles;
  for (const auto face : shell.faces()) {
    std::vector<Exact::Point_3> corners;
    for (const auto corner : vertices_around_face(shell.halfedge(face), shell)) corners.push_back(shell.point(corner));
    triangles.add_polyhedron(Nef(corners.begin(), corners.end()));
  }
  Nef solid = triangles.get_union();
  CGAL::Mark_bounded_volumes<Nef> fill(true);
  solid.delegate(fill);
  return solid.regularization();
}

// Returns the solid of a surface. CGAL takes all that a surface encloses as solid, so cavities are subtracted, and
// shells within them are added again: the larger a shell, the earlier.
Nef nef_of(const ExactMesh& surface) {
  namespace processing = CGAL::Polygon_mesh_processing;
  std::vector<ExactMesh> shells;
  processing::split_connected_components(surface, shells);
  std::vector<std::pair<Exact::FT, size_t>> volumes;
  for (size_t n = 0; n < shells.size(); ++n) volumes.emplace_back(processing::volume(shells[n]), n);
  const bool has_cavities = std::ranges::any_of(volumes, [](const auto& volume) { return volume.first < 0; });
  if (!has_cavities && !touches_itself(surface)) return Nef(ExactMesh(surface));
  std::ranges::sort(volumes, [](const auto& a, const auto& b) {
    const Exact::FT of_a = CGAL::abs(a.first), of_b = CGAL::abs(b.first);
    return of_a != of_b ? of_a > of_b : a.second < b.second;
  });
  Nef solid;
  for (const auto& [volume, n] : volumes) {
    if (volume < 0) processing::reverse_face_orientations(shells[n]);
    const Nef shell = nef_of_shell(shells[n]);
    solid = volume > 0 ? solid + shell : solid - shell;
  }
  return solid;
}

Nef solid_of(const Part& part) { return part.nef ? part.nef->solid() : nef_of(part.surface); }

// Sorts points and polygons, because the order in which CGAL visits a Nef polyhedron may depend on memory addresses.
void put_in_order(std::vector<Exact::Point_3>& points, std::vector<std::vector<std::size_t>>& polygons) {
  std::vector<size_t> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return CGAL::lexicographically_xyz_smaller(points[a], points[b]); });
  std::vector<Exact::Point_3> sorted;
  for (size_t n = 0; n < order.size(); ++n) {
    sorted.push_back(points[order[n]]);
    place[order[n]] = n;
  }
  points = std::move(sorted);
  for (auto& polygon : polygons) {
    for (size_t& corner : polygon) corner = place[corner];
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
  }
  std::sort(polygons.begin(), polygons.end());
}

Part whole_of(const Nef& nef, ExactMesh surface) { return {std::move(surface), std::make_shared<const NefSolid>(nef)}; }

ExactMesh surface_of(const Nef& nef) {
  std::vector<Exact::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  CGAL::convert_nef_polyhedron_to_polygon_soup(nef, points, polygons, true);
  put_in_order(points, polygons);
  return mesh_of_soup(std::move(points), std::move(polygons));
}

// Splits a solid into parts at shells that touch each other; a shell that touches itself keeps its solid in one part.
Parts parts_of(const Nef& nef) {
  if (nef.is_empty()) return {};
  ExactMesh surface = surface_of(nef);
  Parts parts;
  for (ExactMesh& shell : apart(surface)) {
    if (touches_itself(shell)) return {whole_of(nef, std::move(surface))};
    parts.emplace_back(std::move(shell));
  }
  return parts;
}

}  // namespace

bool touches_itself(const ExactMesh& mesh) {
  std::vector<Exact::Point_3> points(mesh.points().begin(), mesh.points().end());
  std::ranges::sort(points, [](const auto& a, const auto& b) { return CGAL::lexicographically_xyz_smaller(a, b); });
  return std::adjacent_find(points.begin(), points.end()) != points.end();
}

Parts combine_nef(Boolean operation, const Part& a, const Part& b) {
  try {
    const Nef first = solid_of(a), second = solid_of(b);
    switch (operation) {
      case Boolean::unite:
        return parts_of((first + second).regularization());
      case Boolean::intersect:
        return parts_of((first * second).regularization());
      case Boolean::subtract:
        return parts_of((first - second).regularization());
    }
  } catch (const std::exception& failure) {
    throw Error(
        Code::surface_crosses,
        std::string("two solids cannot be combined, most likely since a surface crosses itself: ") + failure.what());
  }
  return {};
}

Part touching_part(ExactMesh surface) {
  try {
    const Nef nef = nef_of(surface);
    return whole_of(nef, std::move(surface));
  } catch (const std::exception& failure) {
    throw Error(Code::surface_crosses, std::string("its surface crosses and touches itself: ") + failure.what());
  }
}

Part moved_nef(const Part& part, const CGAL::Aff_transformation_3<Exact>& map) {
  Nef nef = solid_of(part);
  nef.transform(map);
  ExactMesh surface = surface_of(nef);
  return whole_of(nef, std::move(surface));
}

std::vector<TriangleMesh> convex_parts_nef(const Part& part) {
  Nef nef = solid_of(part);
  CGAL::convex_decomposition_3(nef);
  std::vector<TriangleMesh> parts;
  for (auto volume = ++nef.volumes_begin(); volume != nef.volumes_end(); ++volume) {
    if (!volume->mark()) continue;
    CGAL::Polyhedron_3<Exact> shell;
    nef.convert_inner_shell_to_polyhedron(volume->shells_begin(), shell);
    std::vector<Vec3> points;
    for (auto p = shell.points_begin(); p != shell.points_end(); ++p)
      points.push_back({CGAL::to_double(p->x()), CGAL::to_double(p->y()), CGAL::to_double(p->z())});
    parts.push_back(hull_of(points));
  }
  return parts;
}

}  // namespace ombre::solids
