// Writes OFF as text with a colour for each face.
#include "formats/containers/append_numbers.h"
#include "formats/mesh/body_colours.h"
#include "formats/mesh/mesh_writers.h"

namespace ombre::formats {
namespace {

void append_vertex(std::string& text, Vec3 p) {
  append_point(text, p);
  text += '\n';
}

void append_face(std::string& text, const std::array<uint32_t, 3>& triangle, uint64_t first_vertex,
                 const Rgba& colour) {
  text += '3';
  for (const uint32_t corner : triangle) {
    text += ' ';
    append_count(text, first_vertex + corner);
  }
  for (const uint8_t part : colour) {
    text += ' ';
    append_count(text, part);
  }
  text += '\n';
}

}  // namespace

LazyBytes off_bytes(const MeshDocument& document) {
  LazyBytes bytes;
  bytes.add("OFF\n# mm, z is up\n" + std::to_string(document.vertex_count()) + ' ' +
            std::to_string(document.triangle_count()) + " 0\n");
  for (const MeshBody& body : document.bodies)
    bytes.add_rows(body.vertices.size(),
                   [&body](std::string& text, size_t index) { append_vertex(text, body.vertices[index]); });
  uint64_t first_vertex = 0;
  for (const MeshBody& body : document.bodies) {
    const Rgba colour = colour_of(document, body);
    bytes.add_rows(body.triangles.size(), [&body, first_vertex, colour](std::string& text, size_t index) {
      append_face(text, body.triangles[index], first_vertex, colour);
    });
    first_vertex += body.vertices.size();
  }
  return bytes;
}

}  // namespace ombre::formats
