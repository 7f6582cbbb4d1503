// Colours of bodies and their vertices.
#pragma once

#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

// Returns the colour of the body's material; gray if it has none.
inline Rgba colour_of(const MeshDocument& document, const MeshBody& body) {
  return body.material ? document.materials[*body.material].colour : MeshMaterial{}.colour;
}

inline Rgba colour_of_vertex(const MeshDocument& document, const MeshBody& body, size_t vertex) {
  return body.vertex_colours.empty() ? colour_of(document, body) : body.vertex_colours[vertex];
}

}  // namespace ombre::formats
