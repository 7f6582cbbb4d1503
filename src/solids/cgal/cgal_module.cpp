// The geometry kernel by CGAL: exact coordinates, booleans by corefinement, and Nef polyhedra where that fails.
#include "solids/cgal/cgal_boxes.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Random.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <optional>

#include "base/text/error.h"
#include "solids/cgal/cgal_body.h"
#include "solids/kernel_calls.h"

namespace ombre::solids {

namespace processing = CGAL::Polygon_mesh_processing;

namespace {

struct Soup {
  std::vector<Exact::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

Soup soup_of(const TriangleMesh& mesh) {
  Soup soup;
  for (const Vec3& p : mesh.points) soup.points.emplace_back(p.x, p.y, p.z);
  for (const auto& [a, b, c] : mesh.triangles) soup.polygons.push_back({a, b, c});
  return soup;
}

void turn_outward(ExactMesh& mesh, std::string& remark) {
  if (processing::does_bound_a_volume(mesh) && processing::is_outward_oriented(mesh)) return;
  processing::orient_to_bound_a_volume(mesh);
  remark = "is inside out, in part or as a whole; it was turned";
}

bool meet(const Box& a, const Box& b) { return !intersect(a, b).is_empty(); }

bool try_corefinement(Boolean operation, ExactMesh first, ExactMesh second, ExactMesh& result) {
  CGAL::get_default_random() = CGAL::Random(0);  // determines the order in which crossings are found
  switch (operation) {
    case Boolean::unite:
      return processing::corefine_and_compute_union(first, second, result);
    case Boolean::intersect:
      return processing::corefine_and_compute_intersection(first, second, result);
    case Boolean::subtract:
      return processing::corefine_and_compute_difference(first, second, result);
  }
  return false;
}

// Computes a boolean by corefinement. Returns false if that fails; the result may be empty.
bool corefined(Boolean operation, const ExactMesh& a, const ExactMesh& b, ExactMesh& result) {
  try {
    if (!try_corefinement(operation, a, b, result)) return false;
  } catch (const std::exception&) {  // thrown by CGAL's checks
    return false;
  }
  result.collect_garbage();
  for (const auto vertex : result.vertices()) CGAL::exact(result.point(vertex));
  return true;
}

using Meshes = std::vector<ExactMesh>;

// Returns null if corefinement fails or leaves a shell that touches itself; surfaces that meet in a corner become two
// shells.
std::optional<Parts> corefined_parts(Boolean operation, const Part& a, const Part& b) {
  ExactMesh result;
  if (a.nef || b.nef || touches_itself_after(operation, a.surface, b.surface)) return std::nullopt;
  if (!corefined(operation, a.surface, b.surface, result)) return std::nullopt;
  if (result.number_of_faces() == 0) return Parts();
  Parts parts;
  if (!touches_itself(result)) {
    parts.emplace_back(std::move(result));
    return parts;
  }
  for (ExactMesh& shell : apart(result)) {
    if (touches_itself(shell)) return std::nullopt;
    parts.emplace_back(std::move(shell));
  }
  return parts;
}

Parts combined(Boolean operation, const Part& a, const Part& b) {
  auto parts = corefined_parts(operation, a, b);
  return parts ? std::move(*parts) : combine_nef(operation, a, b);
}

void add_combined(Boolean operation, const Part& a, const Part& b, Parts& results) {
  for (Part& part : combined(operation, a, b)) results.push_back(std::move(part));
}

Exact::FT volume_of(const Part& part) { return processing::volume(part.surface); }
Box box_of(const Part& part) { return solids::box_of(part.surface); }

Parts subtracted(const Parts& from, const Parts& others) {
  Parts left = from;
  for (const Part& other : others) {
    Parts next;
    for (const Part& part : left) {
      if (meet(box_of(part), box_of(other)))
        add_combined(Boolean::subtract, part, other, next);
      else
        next.push_back(part);
    }
    left = std::move(next);
  }
  return left;
}

Parts intersected(const Parts& some, const Parts& others) {
  Parts common;
  for (const Part& a : some)
    for (const Part& b : others)
      if (meet(box_of(a), box_of(b))) add_combined(Boolean::intersect, a, b, common);
  return common;
}

// Unites two parts whose boxes meet. Returns false if they only touch or are apart, so that they stay two.
bool join(const Part& a, const Part& b, Parts& joined) {
  joined = combined(Boolean::unite, a, b);
  if (joined.size() < 2) return true;
  Exact::FT volume = 0;
  for (const Part& part : joined) volume += volume_of(part);
  return volume != volume_of(a) + volume_of(b);
}

Parts united(Parts some, Parts waiting) {
  std::reverse(waiting.begin(), waiting.end());
  while (!waiting.empty()) {
    Part next = std::move(waiting.back());
    waiting.pop_back();
    Parts joined;
    const auto other = std::find_if(some.begin(), some.end(), [&](const Part& part) {
      return meet(box_of(part), box_of(next)) && join(part, next, joined);
    });
    if (other == some.end()) {
      some.push_back(std::move(next));
      continue;
    }
    some.erase(other);
    for (Part& part : joined) waiting.push_back(std::move(part));
  }
  return some;
}

// Returns the union of the outward shells less that of the inward ones; shells may cross or touch each other.
Parts of_shells(const ExactMesh& mesh) {
  Meshes shells;
  Parts solids, cavities;
  processing::split_connected_components(mesh, shells);
  for (ExactMesh& shell : shells) {
    if (processing::does_self_intersect(shell)) throw Error(Code::surface_crosses, "its surface crosses itself");
    const bool is_cavity = !processing::is_outward_oriented(shell);
    if (is_cavity) processing::reverse_face_orientations(shell);
    (is_cavity ? cavities : solids).emplace_back(std::move(shell));
  }
  return subtracted(united({}, std::move(solids)), cavities);
}

BodyPtr body_of(Parts parts) { return std::make_shared<CgalBody>(std::move(parts)); }

// Returns the height of a point above the plane of a triangle.
double height_above(const std::array<Vec3, 3>& triangle, Vec3 point) {
  const Vec3 normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double size = length(normal);
  return size > 0 ? dot(normal, point - triangle[0]) / size : 0;
}

// Returns true if the mesh has a reflex edge; a closed connected surface without one is convex. Faces with more than
// three corners, such as those of balls, are flat only up to the rounding of their corners, which is tolerated.
bool has_reflex_edge(const ExactMesh& mesh) {
  constexpr double rounding = 1e-12;  // relative to the size of the solid
  Box box;
  std::vector<Vec3> points(mesh.num_vertices());
  for (const auto vertex : mesh.vertices()) {
    const Exact::Point_3& p = mesh.point(vertex);
    points[vertex] = {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
    box = hull(box, {points[vertex], points[vertex]});
  }
  const double tolerated = rounding * length(box.size());
  for (const auto edge : mesh.edges()) {
    const auto side = mesh.halfedge(edge);
    const std::array corners{mesh.source(side), mesh.target(side), mesh.target(mesh.next(side))};
    const auto beyond = mesh.target(mesh.next(mesh.opposite(side)));
    if (CGAL::orientation(mesh.point(corners[0]), mesh.point(corners[1]), mesh.point(corners[2]), mesh.point(beyond)) !=
        CGAL::POSITIVE)
      continue;
    if (height_above({points[corners[0]], points[corners[1]], points[corners[2]]}, points[beyond]) > tolerated)
      return true;
  }
  return false;
}

class CgalKernel : public Kernel {
 public:
  BodyPtr body(const TriangleMesh& mesh, bool is_trusted, std::string& remark) const override {
    Soup soup = soup_of(mesh);
    const bool touches = !processing::is_polygon_soup_a_polygon_mesh(soup.polygons);
    ExactMesh exact = mesh_of_soup(std::move(soup.points), std::move(soup.polygons));
    if (!CGAL::is_closed(exact)) throw Error(Code::surface_open, "its surface is not closed");
    if (!is_trusted || touches) {
      if (processing::does_self_intersect(exact)) return body_of(of_shells(exact));
      turn_outward(exact, remark);
    }
    Parts parts;
    parts.emplace_back(std::move(exact));
    return body_of(std::move(parts));
  }

  BodyPtr wound(const TriangleMesh& mesh) const override { return body_of(wound_parts(mesh)); }

  BodyPtr moved(const Body& body, const Affine& map) const override {
    const auto& [x, y, z] = map.rows;
    const Vec3& t = map.offset;
    const CGAL::Aff_transformation_3<Exact> exact(x.x, x.y, x.z, t.x, y.x, y.y, y.z, t.y, z.x, z.y, z.z, t.z, 1);
    Parts parts = cgal(body).parts();
    for (Part& part : parts) {
      if (part.nef) {
        part = moved_nef(part, exact);
        continue;
      }
      ExactMesh& mesh = part.surface;
      for (const auto vertex : mesh.vertices()) mesh.point(vertex) = exact(mesh.point(vertex));
      if (exact.is_odd()) processing::reverse_face_orientations(mesh);
    }
    return body_of(std::move(parts));
  }

  BodyPtr combine(Boolean operation, const Body& a, const Body& b) const override {
    const Parts &first = cgal(a).parts(), &second = cgal(b).parts();
    switch (operation) {
      case Boolean::unite:
        return body_of(united(first, second));
      case Boolean::intersect:
        return body_of(intersected(first, second));
      case Boolean::subtract:
        return body_of(subtracted(first, second));
    }
    return nullptr;
  }

  BodyPtr gathered(std::span<const BodyPtr> bodies) const override {
    Parts all, touching;
    for (const BodyPtr& body : bodies) {
      size_t n = 0;
      for (const Part& part : cgal(*body).parts()) {
        if (part.nef) {
          touching.push_back(part);
          continue;
        }
        if (all.size() <= n) all.emplace_back();
        CGAL::copy_face_graph(part.surface, all[n++].surface);
      }
    }
    all.insert(all.end(), touching.begin(), touching.end());
    return body_of(std::move(all));
  }

  TriangleMesh hull(std::span<const Vec3> points) const override { return hull_of(points); }

  bool is_convex(const Body& body) const override {
    const Parts& parts = cgal(body).parts();
    if (parts.size() != 1 || parts[0].nef || has_reflex_edge(parts[0].surface)) return false;
    Meshes shells;
    processing::split_connected_components(parts[0].surface, shells);
    return shells.size() == 1;
  }

  std::vector<TriangleMesh> convex_parts(const Body& body) const override {
    std::vector<TriangleMesh> all;
    for (const Part& part : cgal(body).parts())
      for (TriangleMesh& piece : convex_parts_nef(part)) all.push_back(std::move(piece));
    return all;
  }

  PlaneTriangles triangulate(std::span<const Ring> rings) const override { return triangulate_rings(rings); }

  TriangleMesh roof(std::span<const Ring> rings) const override { return roof_over(rings); }
};

void append(const ExactMesh& mesh, TriangleMesh& all) {
  std::vector<uint32_t> number(mesh.num_vertices());
  for (const auto vertex : mesh.vertices()) {
    const Exact::Point_3& p = mesh.point(vertex);
    number[vertex] = static_cast<uint32_t>(all.points.size());
    all.points.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }
  for (const auto face : mesh.faces()) {
    const auto side = mesh.halfedge(face);
    all.triangles.push_back(
        {number[mesh.source(side)], number[mesh.target(side)], number[mesh.target(mesh.next(side))]});
  }
}

}  // namespace

CgalBody::CgalBody(Parts parts) : parts_(std::move(parts)) {
  for (const Part& part : parts_) {
    const ExactMesh& mesh = part.surface;
    for (const auto vertex : mesh.vertices()) CGAL::exact(mesh.point(vertex));
    bounds_ = hull(bounds_, box_of(mesh));
  }
}

TriangleMesh CgalBody::mesh() const {
  TriangleMesh all;
  for (const Part& part : parts_) append(part.surface, all);
  return all;
}

Box box_of(const ExactMesh& mesh) {
  Box box;
  for (const auto vertex : mesh.vertices()) {
    const CGAL::Bbox_3 b = mesh.point(vertex).bbox();
    box = hull(box, Box{{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}});
  }
  return box;
}

std::vector<ExactMesh> apart(const ExactMesh& mesh) {
  Meshes shells, solids, cavities;
  processing::split_connected_components(mesh, shells);
  for (ExactMesh& shell : shells)
    (processing::is_outward_oriented(shell) ? solids : cavities).push_back(std::move(shell));
  for (const ExactMesh& cavity : cavities) {
    // A cavity lies in all solids that contain its corners; the smallest of them is its own.
    ExactMesh* own = nullptr;
    for (ExactMesh& solid : solids) {
      if (!meet(box_of(solid), box_of(cavity))) continue;
      const CGAL::Side_of_triangle_mesh<ExactMesh, Exact> side(solid);
      const auto corners = cavity.vertices();
      const bool holds = std::all_of(corners.begin(), corners.end(), [&](const auto vertex) {
        return side(cavity.point(vertex)) != CGAL::ON_UNBOUNDED_SIDE;
      });
      if (holds && (!own || processing::volume(solid) < processing::volume(*own))) own = &solid;
    }
    if (own) CGAL::copy_face_graph(cavity, *own);
  }
  return solids;
}

}  // namespace ombre::solids

const ombre::solids::Kernel* ombre_solids_kernel() {
  static const ombre::solids::CgalKernel kernel;
  return &kernel;
}
