#include "sources/solid_parts.h"

#include "solids/colour_bytes.h"

namespace ombre::sources {

design::SolidsRequest solids_request(const solids::Pieces& pieces, std::string name, design::MeshUse use) {
  auto made = std::make_shared<std::vector<design::MadeSolid>>();
  for (const solids::Piece& piece : pieces) {
    if (!piece.solid()) continue;
    const auto& [material, part, colour] = piece.attributes;
    const solids::TriangleMesh& mesh = piece.solid()->mesh();
    made->push_back({part, material, colour ? std::optional(solids::bytes_of(*colour)) : std::nullopt, mesh.points,
                     mesh.triangles});
  }
  return {std::move(name), std::move(made), std::move(use)};
}

}  // namespace ombre::sources
