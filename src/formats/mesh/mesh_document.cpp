#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

size_t MeshDocument::vertex_count() const {
  size_t count = 0;
  for (const MeshBody& body : bodies) count += body.vertices.size();
  return count;
}

size_t MeshDocument::triangle_count() const {
  size_t count = 0;
  for (const MeshBody& body : bodies) count += body.triangles.size();
  return count;
}

size_t MeshDocument::beam_count() const {
  size_t count = 0;
  for (const WrittenBeams& lattice : beams) count += lattice.beams.size();
  return count;
}

}  // namespace ombre::formats
