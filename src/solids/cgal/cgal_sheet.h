// Sheets of triangles as surface meshes of CGAL.
#pragma once

#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/math/vec.h"
#include "base/text/error.h"

namespace ombre::importing {

template <class Kernel>
using Sheet = CGAL::Surface_mesh<typename Kernel::Point_3>;

// Throws Error with `problem` if the triangles do not form sheets with one or two triangles at each edge.
template <class Kernel>
Sheet<Kernel> sheet_of(const std::vector<Vec3>& points, const std::vector<std::array<uint32_t, 3>>& triangles,
                       const std::string& problem) {
  Sheet<Kernel> sheet;
  using Vertex = typename Sheet<Kernel>::Vertex_index;
  for (const Vec3& p : points) sheet.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : triangles)
    if (sheet.add_face(Vertex(a), Vertex(b), Vertex(c)) == Sheet<Kernel>::null_face())
      throw Error(Code::file_content, problem + ": its triangles do not form one sheet");
  return sheet;
}

}  // namespace ombre::importing
