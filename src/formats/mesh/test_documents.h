// Small documents for tests of mesh files.
#pragma once

#include <string>

#include "formats/containers/lazy_bytes.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/mesh_document.h"

namespace ombre::formats::test {

// Returns a tetrahedron with corners (0,0,0), (1,0,0), (0,2,0) and (0,0,4), which has a volume of 8/6 mm3.
inline MeshBody tetrahedron(const std::string& name, Vec3 at = {}) {
  return {name,
          {at, at + Vec3{1, 0, 0}, at + Vec3{0, 2, 0}, at + Vec3{0, 0, 4}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}
inline constexpr double tetrahedron_mm3 = 8.0 / 6;

// Returns two tetrahedra of two materials.
inline MeshDocument pair() {
  MeshDocument document{"pair", {{"red", {255, 0, 0, 255}}, {"clear blue", {0, 0, 255, 51}}}, {}};
  document.bodies = {tetrahedron("left"), tetrahedron("right", {10, 0, 0})};
  document.bodies[0].material = 0;
  document.bodies[1].material = 1;
  return document;
}

inline std::string whole(const LazyBytes& bytes) {
  std::string text;
  bytes.write([&text](std::string_view piece) { text += piece; });
  return text;
}

inline double volume(const Mesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles) six += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
  return six / 6;
}

}  // namespace ombre::formats::test
