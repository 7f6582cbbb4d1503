// The elements of meshes in 3MF models.
#pragma once

#include <optional>
#include <string>

#include "formats/containers/lazy_bytes.h"
#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

// Attributes of triangles other than their corners.
struct TriangleProperties {
  uint64_t group = 0;                     // 0 for none
  std::optional<uint32_t> all = {};       // one property for all corners; if null, each vertex has its own
  std::string_view paint_attribute = {};  // empty, or the attribute for the extruder of the surface
};

void append_model_vertex(std::string& text, Vec3 p);
void add_model_vertices(LazyBytes& bytes, const MeshBody& body);
// Adds triangles whose vertices are numbered from `first_vertex`.
void add_model_triangles(LazyBytes& bytes, const MeshBody& body, uint64_t first_vertex,
                         const TriangleProperties& properties);
// Adds an element <mesh> of one body.
void add_mesh(LazyBytes& bytes, const MeshBody& body, const TriangleProperties& properties);

bool has_paint(const MeshDocument& document);

}  // namespace ombre::formats
