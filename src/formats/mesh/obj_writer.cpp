// Writes Wavefront OBJ and its material library.
#include "formats/containers/append_numbers.h"
#include "formats/mesh/mesh_writers.h"

namespace ombre::formats {
namespace {

// Returns a name without blanks and special characters: readers end a name at a space, and a line at a backslash or #.
std::string one_word(const std::string& name) {
  std::string word;
  for (const char c : name) {
    const auto code = static_cast<unsigned char>(c);
    word += code <= 0x20 || code == 0x7f || c == '#' || c == '\\' ? '_' : c;
  }
  return word.empty() ? "_" : word;
}

void append_vertex(std::string& text, const MeshBody& body, size_t index) {
  text += "v ";
  append_point(text, body.vertices[index]);
  if (!body.vertex_colours.empty()) {
    const Rgba& colour = body.vertex_colours[index];
    text += ' ';
    append_point(text, {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0});
  }
  text += '\n';
}

void append_face(std::string& text, const MeshBody& body, size_t index, uint64_t first_vertex) {
  text += 'f';
  for (const uint32_t corner : body.triangles[index]) {
    text += ' ';
    append_count(text, first_vertex + corner);
  }
  text += '\n';
}

void add_body(LazyBytes& bytes, const MeshDocument& document, const MeshBody& body, uint64_t first_vertex) {
  bytes.add("o " + one_word(body.name) + '\n');
  bytes.add_rows(body.vertices.size(), [&body](std::string& text, size_t index) { append_vertex(text, body, index); });
  if (body.material) bytes.add("usemtl " + one_word(document.materials[*body.material].name) + '\n');
  bytes.add_rows(body.triangles.size(), [&body, first_vertex](std::string& text, size_t index) {
    append_face(text, body, index, first_vertex);
  });
}

}  // namespace

LazyBytes obj_bytes(const MeshDocument& document, const std::string& library_name) {
  LazyBytes bytes;
  bytes.add("# mm, z is up\n");
  if (!document.materials.empty()) bytes.add("mtllib " + library_name + '\n');
  uint64_t first_vertex = 1;
  for (const MeshBody& body : document.bodies) {
    if (body.triangles.empty()) continue;
    add_body(bytes, document, body, first_vertex);
    first_vertex += body.vertices.size();
  }
  return bytes;
}

LazyBytes mtl_bytes(const MeshDocument& document) {
  std::string text;
  for (const MeshMaterial& material : document.materials) {
    const auto& [red, green, blue, alpha] = material.colour;
    text += "newmtl " + one_word(material.name) + "\nKd ";
    append_point(text, {red / 255.0, green / 255.0, blue / 255.0});
    text += "\nd ";
    append_float(text, alpha / 255.0);
    text += '\n';
  }
  LazyBytes bytes;
  bytes.add(std::move(text));
  return bytes;
}

}  // namespace ombre::formats
