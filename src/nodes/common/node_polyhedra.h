// The exact polyhedra of nodes, for formats of triangles.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "design/node.h"

namespace ombre::solids {
struct Piece;
}

namespace ombre::nodes {

// Solids with, for each, its name, which may be empty, and its material. Where they overlap, the first one wins.
struct Polyhedra {
  std::shared_ptr<const std::vector<solids::Piece>> pieces;
  std::vector<std::string> names;
  std::vector<const design::Material*> materials;
};

// Returns the solids of which the node consists. Returns nothing for nodes that do not consist of polyhedra, and for
// those with a mixture.
std::optional<Polyhedra> polyhedra_of(const design::Node& node);

}  // namespace ombre::nodes
