#include "fea/model/element_points.h"

#include <cmath>

namespace ombre::fea {
namespace {

// Coordinate of Gauss' points of a hexahedron, 1 / sqrt(3); coordinates go from -1 to 1.
constexpr double gauss = 0.57735026918962576;
// Barycentric coordinates of the four points of a tetrahedron that integrate polynomials of degree 2.
constexpr double near_corner = 0.58541019662496852, far_corner = 0.13819660112501051;

// Gradients of the barycentric coordinates of a tetrahedron, and its volume.
struct Barycentric {
  std::array<Vec3, 4> gradients;
  double volume_mm3;
};

Barycentric barycentric(const MeshView& mesh, size_t element) {
  const auto n = mesh.nodes(element);
  const Vec3 a = mesh.node(n[0]), u = mesh.node(n[1]) - a, v = mesh.node(n[2]) - a, w = mesh.node(n[3]) - a;
  const double six_volumes = dot(cross(u, v), w);
  const double scale = 1 / six_volumes;
  Barycentric found{{{{}, scale * cross(v, w), scale * cross(w, u), scale * cross(u, v)}}, six_volumes / 6};
  found.gradients[0] = -(found.gradients[1] + found.gradients[2] + found.gradients[3]);
  return found;
}

ElementPoint quadratic_at(const Barycentric& tetrahedron, const std::array<double, 4>& at, double volume) {
  constexpr std::array<std::array<size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
  ElementPoint point{volume, {}};
  for (size_t n = 0; n < 4; ++n) point.gradients[n] = (4 * at[n] - 1) * tetrahedron.gradients[n];
  for (size_t edge = 0; edge < 6; ++edge) {
    const auto [a, b] = edges[edge];
    point.gradients[4 + edge] = 4 * at[a] * tetrahedron.gradients[b] + 4 * at[b] * tetrahedron.gradients[a];
  }
  return point;
}

// `at` has coordinates from -1 to 1; `weight` is the share of a cube of side 2.
ElementPoint hexahedron_at(const MeshView& mesh, size_t element, Vec3 at, double weight) {
  const auto nodes = mesh.nodes(element);
  std::array<Vec3, 8> natural;
  std::array<Vec3, 3> columns{};  // columns of the map's derivative
  for (size_t n = 0; n < 8; ++n) {
    std::array<double, 3> sign{}, factor{};
    for (size_t axis = 0; axis < 3; ++axis) {
      sign[axis] = brick_corners[n][axis] == 1 ? 1 : -1;
      factor[axis] = 1 + sign[axis] * at[static_cast<int>(axis)];
    }
    natural[n] =
        0.125 * Vec3{sign[0] * factor[1] * factor[2], factor[0] * sign[1] * factor[2], factor[0] * factor[1] * sign[2]};
    const Vec3 p = mesh.node(nodes[n]);
    for (size_t axis = 0; axis < 3; ++axis) columns[axis] = columns[axis] + natural[n][static_cast<int>(axis)] * p;
  }
  const double determinant = dot(cross(columns[0], columns[1]), columns[2]);
  const std::array<Vec3, 3> inverse{(1 / determinant) * cross(columns[1], columns[2]),
                                    (1 / determinant) * cross(columns[2], columns[0]),
                                    (1 / determinant) * cross(columns[0], columns[1])};
  ElementPoint point{weight * determinant, {}};
  for (size_t n = 0; n < 8; ++n)
    point.gradients[n] = natural[n].x * inverse[0] + natural[n].y * inverse[1] + natural[n].z * inverse[2];
  return point;
}

ElementPoint linear(const Barycentric& tetrahedron) {
  ElementPoint point{tetrahedron.volume_mm3, {}};
  for (size_t n = 0; n < 4; ++n) point.gradients[n] = tetrahedron.gradients[n];
  return point;
}

}  // namespace

void find_points(const MeshView& mesh, size_t element, ElementPoints& found) {
  if (mesh.kind() == ElementKind::c3d8) {
    found.count = 8;
    for (size_t n = 0; n < 8; ++n) {
      const Cell& corner = brick_corners[n];
      const auto place = [&](size_t axis) { return corner[axis] == 1 ? gauss : -gauss; };
      found.points[n] = hexahedron_at(mesh, element, {place(0), place(1), place(2)}, 1);
    }
    return;
  }
  const Barycentric tetrahedron = barycentric(mesh, element);
  if (mesh.kind() == ElementKind::c3d4) {
    found.count = 1;
    found.points[0] = linear(tetrahedron);
    return;
  }
  found.count = 4;
  for (size_t n = 0; n < 4; ++n) {
    std::array<double, 4> at{far_corner, far_corner, far_corner, far_corner};
    at[n] = near_corner;
    found.points[n] = quadratic_at(tetrahedron, at, tetrahedron.volume_mm3 / 4);
  }
}

ElementPoint middle_point(const MeshView& mesh, size_t element) {
  if (mesh.kind() == ElementKind::c3d8) {
    const Fill fill = mesh.bricks() ? mesh.bricks()->fill(element) : full_fill;
    const Vec3 at = fill == full_fill ? Vec3{} : 2.0 * fill_centre(fill) - Vec3{1, 1, 1};
    return hexahedron_at(mesh, element, {at.x, at.y, at.z}, 8);
  }
  const Barycentric tetrahedron = barycentric(mesh, element);
  if (mesh.kind() == ElementKind::c3d4) return linear(tetrahedron);
  return quadratic_at(tetrahedron, {0.25, 0.25, 0.25, 0.25}, tetrahedron.volume_mm3);
}

}  // namespace ombre::fea
