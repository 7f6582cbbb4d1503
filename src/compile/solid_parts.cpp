#include "compile/solid_parts.h"

#include <algorithm>
#include <cmath>

namespace ombre::compile {
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
  bool names_materials = false;
  for (const solids::Piece& piece : pieces) {
    if (!piece.solid()) continue;
    const auto& [material, part, colour] = piece.attributes;
    names_materials |= !material.empty();
    const solids::TriangleMesh& mesh = piece.solid()->mesh();
    made->push_back(
        {part, material, colour ? std::optional(rgba_of(*colour)) : std::nullopt, mesh.points, mesh.triangles});
  }
  if (names_materials && use.materials == "one") use.materials = "names";
  return {std::move(name), std::move(made), std::move(use)};
}

}  // namespace ombre::compile
