// Writes binary STL: a header of 80 bytes, a count, 50 bytes for each triangle.
#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/containers/append_numbers.h"
#include "formats/mesh/mesh_writers.h"

namespace ombre::formats {
namespace {

constexpr size_t header_bytes = 80;

// Returns the header, which must not begin with "solid", as text does.
std::string header(size_t triangles) {
  std::string bytes = "binary STL, mm";
  bytes.resize(header_bytes, '\0');
  append_u32(bytes, static_cast<uint32_t>(triangles));
  return bytes;
}

// Returns the unit normal; zero for a triangle without area.
Vec3 normal(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 doubled = cross(b - a, c - a);
  const double size = length(doubled);
  return size > 0 ? (1 / size) * doubled : Vec3{};
}

void append_triangle(std::string& bytes, const MeshBody& body, size_t index) {
  const auto& [i, j, k] = body.triangles[index];
  const Vec3 a = body.vertices[i], b = body.vertices[j], c = body.vertices[k];
  for (const Vec3 p : {normal(a, b, c), a, b, c}) append_point_f32(bytes, p);
  bytes.append(2, '\0');  // no attributes
}

}  // namespace

LazyBytes stl_bytes(const MeshDocument& document) {
  const size_t count = document.triangle_count();
  if (count > UINT32_MAX)
    throw Error(Code::too_large, "an STL file holds at most 4,294,967,295 triangles, here are " + format_count(count) +
                                     "; write a .ply file");
  LazyBytes bytes;
  bytes.add(header(count));
  for (const MeshBody& body : document.bodies)
    bytes.add_rows(body.triangles.size(),
                   [&body](std::string& out, size_t index) { append_triangle(out, body, index); });
  return bytes;
}

}  // namespace ombre::formats
