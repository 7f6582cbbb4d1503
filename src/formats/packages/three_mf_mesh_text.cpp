#include "formats/packages/three_mf_mesh_text.h"

#include <algorithm>

#include "formats/containers/append_numbers.h"
#include "formats/containers/xml_text.h"
#include "formats/slicers/painting.h"

namespace ombre::formats {
namespace {

void append_triangle(std::string& text, const MeshBody& body, size_t index, uint64_t first_vertex,
                     const TriangleProperties& properties) {
  const std::array<uint32_t, 3>& t = body.triangles[index];
  text += "<triangle";
  append_xml_attribute(text, "v1", append_count, first_vertex + t[0]);
  append_xml_attribute(text, "v2", append_count, first_vertex + t[1]);
  append_xml_attribute(text, "v3", append_count, first_vertex + t[2]);
  if (properties.group != 0) {
    append_xml_attribute(text, "pid", append_count, properties.group);
    append_xml_attribute(text, "p1", append_count, properties.all.value_or(t[0]));
    if (!properties.all) {
      append_xml_attribute(text, "p2", append_count, t[1]);
      append_xml_attribute(text, "p3", append_count, t[2]);
    }
  }
  if (!properties.paint_attribute.empty() && !body.paint.empty() && body.paint[index] != 0)
    text += xml_attribute(properties.paint_attribute, paint_code(body.paint[index]));
  text += "/>\n";
}

}  // namespace

void append_model_vertex(std::string& text, Vec3 p) {
  text += "<vertex x=\"";
  append_float(text, p.x);
  text += "\" y=\"";
  append_float(text, p.y);
  text += "\" z=\"";
  append_float(text, p.z);
  text += "\"/>\n";
}

void add_model_vertices(LazyBytes& bytes, const MeshBody& body) {
  bytes.add_rows(body.vertices.size(),
                 [&body](std::string& text, size_t index) { append_model_vertex(text, body.vertices[index]); });
}

void add_model_triangles(LazyBytes& bytes, const MeshBody& body, uint64_t first_vertex,
                         const TriangleProperties& properties) {
  bytes.add_rows(body.triangles.size(), [&body, first_vertex, properties](std::string& text, size_t index) {
    append_triangle(text, body, index, first_vertex, properties);
  });
}

void add_mesh(LazyBytes& bytes, const MeshBody& body, const TriangleProperties& properties) {
  bytes.add("<mesh>\n<vertices>\n");
  add_model_vertices(bytes, body);
  bytes.add("</vertices>\n<triangles>\n");
  add_model_triangles(bytes, body, 0, properties);
  bytes.add("</triangles>\n</mesh>\n");
}

bool has_paint(const MeshDocument& document) {
  return std::ranges::any_of(document.bodies, [](const MeshBody& body) { return !body.paint.empty(); });
}

}  // namespace ombre::formats
