#include "sources/solid_parts.h"

#include <algorithm>
#include <cmath>

namespace ombre::sources {
namespace {

design::Rgba rgba_of(const solids::Colour& colour) {
  design::Rgba bytes{};
  for (size_t n = 0; n < bytes.size(); ++n)
    bytes[n] = static_cast<uint8_t>(std::lround(255 * std::clamp(colour[n], 0.0, 1.0)));
  return bytes;
}

}  // namespace

design::SolidsRequest solids_request(const solids::Pieces& pieces, std::string name, design::MeshUse use) {
  auto made = std::make_shared<std::vector<design::MadeSolid>>();
  for (const solids::Piece& piece : pieces) {
    if (!piece.solid()) continue;
    const auto& [material, part, colour] = piece.attributes;
    const solids::TriangleMesh& mesh = piece.solid()->mesh();
    made->push_back(
        {part, material, colour ? std::optional(rgba_of(*colour)) : std::nullopt, mesh.points, mesh.triangles});
  }
  return {std::move(name), std::move(made), std::move(use)};
}

}  // namespace ombre::sources
