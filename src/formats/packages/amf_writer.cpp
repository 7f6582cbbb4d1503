// Writes AMF (ISO/ASTM 52915): one object with a volume for each body, and PrusaSlicer's metadata.
#include "formats/containers/append_numbers.h"
#include "formats/containers/xml_text.h"
#include "formats/packages/package_writers.h"
#include "formats/slicers/slicer_settings.h"

namespace ombre::formats {
namespace {

std::string metadata(std::string_view type, std::string_view value) {
  return "<metadata" + xml_attribute("type", type) + '>' + xml_escaped(value) + "</metadata>\n";
}

template <class Number>
void append_element(std::string& text, std::string_view name, void (&append)(std::string&, Number),
                    std::type_identity_t<Number> value) {
  text.append("<").append(name).append(">");
  append(text, value);
  text.append("</").append(name).append(">");
}

void append_colour(std::string& text, const Rgba& colour) {
  constexpr std::string_view parts[]{"r", "g", "b", "a"};
  text += "<color>";
  for (size_t i = 0; i < colour.size(); ++i) append_element(text, parts[i], append_float, colour[i] / 255.0);
  text += "</color>";
}

// Returns a material; ids count from 1, because 0 is void.
std::string material_text(const MeshMaterial& material, size_t index) {
  std::string text = "<material id=\"" + std::to_string(index + 1) + "\">\n" + metadata("name", material.name);
  append_colour(text, material.colour);
  return text + "\n</material>\n";
}

void append_vertex(std::string& text, const MeshBody& body, size_t index) {
  const Vec3 p = body.vertices[index];
  text += "<vertex><coordinates>";
  append_element(text, "x", append_float, p.x);
  append_element(text, "y", append_float, p.y);
  append_element(text, "z", append_float, p.z);
  text += "</coordinates>";
  if (!body.vertex_colours.empty()) append_colour(text, body.vertex_colours[index]);
  text += "</vertex>\n";
}

void append_triangle(std::string& text, const std::array<uint32_t, 3>& triangle, uint64_t first_vertex) {
  text += "<triangle>";
  append_element(text, "v1", append_count, first_vertex + triangle[0]);
  append_element(text, "v2", append_count, first_vertex + triangle[1]);
  append_element(text, "v3", append_count, first_vertex + triangle[2]);
  text += "</triangle>\n";
}

std::string volume_begin(const MeshBody& body) {
  const std::string material = body.material ? xml_attribute("materialid", std::to_string(*body.material + 1)) : "";
  std::string text = "<volume" + material + ">\n" + metadata("name", body.name);
  for (const auto& [key, value] : slicer_settings(body, SlicerFlavour::generic))
    text += metadata("slic3r." + key, value);
  return text;
}

void add_vertices(LazyBytes& bytes, const MeshDocument& document) {
  bytes.add("<vertices>\n");
  for (const MeshBody& body : document.bodies)
    bytes.add_rows(body.vertices.size(),
                   [&body](std::string& text, size_t index) { append_vertex(text, body, index); });
  bytes.add("</vertices>\n");
}

void add_volumes(LazyBytes& bytes, const MeshDocument& document) {
  uint64_t first_vertex = 0;
  for (const MeshBody& body : document.bodies) {
    if (!body.triangles.empty()) {
      bytes.add(volume_begin(body));
      bytes.add_rows(body.triangles.size(), [&body, first_vertex](std::string& text, size_t index) {
        append_triangle(text, body.triangles[index], first_vertex);
      });
      bytes.add("</volume>\n");
    }
    first_vertex += body.vertices.size();
  }
}

}  // namespace

LazyBytes amf_bytes(const MeshDocument& document) {
  LazyBytes bytes;
  std::string begin = std::string(xml_declaration) + "<amf unit=\"millimeter\" version=\"1.1\">\n";
  for (size_t i = 0; i < document.materials.size(); ++i) begin += material_text(document.materials[i], i);
  bytes.add(begin + "<object id=\"0\">\n" + metadata("name", document.title) + "<mesh>\n");
  add_vertices(bytes, document);
  add_volumes(bytes, document);
  bytes.add("</mesh>\n</object>\n</amf>\n");
  return bytes;
}

}  // namespace ombre::formats
