// Writes binary little-endian PLY with a colour for each vertex.
#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/containers/append_numbers.h"
#include "formats/mesh/body_colours.h"
#include "formats/mesh/mesh_writers.h"

namespace ombre::formats {
namespace {

std::string header(size_t vertices, size_t triangles) {
  return "ply\nformat binary_little_endian 1.0\ncomment mm, z is up\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
         "property uchar blue\nproperty uchar alpha\nelement face " +
         std::to_string(triangles) + "\nproperty list uchar uint vertex_indices\nend_header\n";
}

void append_vertex(std::string& bytes, Vec3 p, const Rgba& colour) {
  append_point_f32(bytes, p);
  for (const uint8_t part : colour) bytes += static_cast<char>(part);
}

void append_face(std::string& bytes, const std::array<uint32_t, 3>& triangle, uint32_t first_vertex) {
  bytes += '\3';
  for (const uint32_t corner : triangle) append_u32(bytes, first_vertex + corner);
}

void add_vertices(LazyBytes& bytes, const MeshDocument& document) {
  for (const MeshBody& body : document.bodies)
    bytes.add_rows(body.vertices.size(), [&document, &body](std::string& out, size_t index) {
      append_vertex(out, body.vertices[index], colour_of_vertex(document, body, index));
    });
}

void add_faces(LazyBytes& bytes, const MeshDocument& document) {
  uint32_t first_vertex = 0;
  for (const MeshBody& body : document.bodies) {
    bytes.add_rows(body.triangles.size(), [&body, first_vertex](std::string& out, size_t index) {
      append_face(out, body.triangles[index], first_vertex);
    });
    first_vertex += static_cast<uint32_t>(body.vertices.size());
  }
}

}  // namespace

LazyBytes ply_bytes(const MeshDocument& document) {
  const size_t vertices = document.vertex_count();
  if (vertices > UINT32_MAX)
    throw Error(Code::too_large,
                "a PLY file numbers at most 4,294,967,295 vertices, here are " + format_count(vertices));
  LazyBytes bytes;
  bytes.add(header(vertices, document.triangle_count()));
  add_vertices(bytes, document);
  add_faces(bytes, document);
  return bytes;
}

}  // namespace ombre::formats
