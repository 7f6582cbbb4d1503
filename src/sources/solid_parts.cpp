#include "sources/solid_parts.h"

#include <algorithm>

#include "lang/openscad/body_names.h"
#include "solids/colour_bytes.h"
#include "sources/mesh_materials.h"

namespace ombre::sources {
namespace {

using design::ScadSolids;

std::vector<std::string> each_once(const std::vector<std::string>& names) {
  std::vector<std::string> once;
  for (const std::string& name : names)
    if (std::ranges::find(once, name) == once.end()) once.push_back(name);
  return once;
}

// Returns the names of the solids' materials in the design; empty ones if it does not ask for materials.
std::vector<std::string> materials_of(const solids::Pieces& pieces, const std::string& name, const design::MeshUse& use,
                                      const design::Reader& reader) {
  if (use.materials == "one") return std::vector<std::string>(pieces.size());
  std::vector<formats::MeshGroup> groups;
  for (const solids::Piece& piece : pieces) {
    const auto& [material, part, colour] = piece.attributes;
    formats::MeshGroup group{part, 0, 0};
    group.material = material;
    if (colour) group.colour = solids::bytes_of(*colour);
    groups.push_back(std::move(group));
  }
  std::vector<std::string> names;
  for (const design::Material* material : find_materials({kind_of(name), "scad", name, {}}, groups, use, reader)
                                              .value_or(std::vector<const design::Material*>()))
    names.push_back(material->name);
  return names;
}

// Returns the solids that have this name.
solids::Pieces called(const std::string& name, const ScadSolids& all) {
  solids::Pieces own;
  for (size_t n = 0; n < all.pieces->size(); ++n)
    if (all.piece_names[n] == name) own.push_back((*all.pieces)[n]);
  return own;
}

// Returns the part of a material if it consists of the solids with this name, else null.
program::SourceField same_part(const std::string& name, const ScadSolids& all) {
  std::optional<std::string> material;
  for (size_t n = 0; n < all.piece_names.size(); ++n)
    if (all.piece_names[n] == name) material = all.piece_materials[n];
  for (size_t n = 0; n < all.piece_names.size(); ++n)
    if ((all.piece_names[n] == name) != (all.piece_materials[n] == material)) return nullptr;
  for (const design::MeshPart& part : all.parts)
    if (part.material == material) return part.source;
  return nullptr;
}

// Returns the bodies. Null, with diagnostics, if a source cannot be made.
std::optional<std::vector<design::ScadBody>> bodies_of(const ScadSolids& all, const std::string& file,
                                                       const design::MeshUse& use, Loading& loading) {
  const std::vector<std::string> names = each_once(all.piece_names);
  if (names.size() == 1) return std::vector<design::ScadBody>{{names[0], nullptr}};
  std::vector<design::ScadBody> bodies;
  for (const std::string& name : names) {
    program::SourceField source = same_part(name, all);
    if (!source) {
      auto request = solids_request(called(name, all), file, {"", use.inside, "one", use.material, {}});
      const auto made = request.load(loading);
      if (!made) return std::nullopt;
      source = made->front().source;
    }
    bodies.push_back({name, std::move(source)});
  }
  return bodies;
}

}  // namespace

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

std::shared_ptr<const ScadSolids> scad_solids(const solids::Pieces& pieces, const std::string& name,
                                              const design::MeshUse& use, Loading& loading) {
  const auto parts = solids_request(pieces, name, use).load(loading);
  if (!parts) return nullptr;
  ScadSolids made{*parts, {}};
  made.pieces = std::make_shared<const solids::Pieces>(pieces);
  made.piece_materials = materials_of(pieces, name, use, loading.reader());
  std::vector<std::string> part_names;
  for (const solids::Piece& piece : pieces) {
    part_names.push_back(piece.attributes.part);
    made.piece_names.push_back(lang::openscad::body_name(piece.attributes));
  }
  made.part_names = each_once(part_names);
  auto bodies = bodies_of(made, name, use, loading);
  if (!bodies) return nullptr;
  made.bodies = std::move(*bodies);
  return std::make_shared<const ScadSolids>(std::move(made));
}

}  // namespace ombre::sources
