// How pieces of different attributes meet in an operator, after the thesis on multi-material OpenSCAD (2023),
// section 3.
#pragma once

#include <vector>

#include "solids/solid.h"

namespace ombre::solids {

// Which attributes keep pieces apart.
enum class Matching {
  all,       // material, part and colour
  material,  // material and part
  none,
};

// What an operator works on at once. Its attributes are those of its first piece that is something.
struct PieceGroup {
  Attributes attributes;
  std::vector<Piece> members;  // in order; empty ones may be among them
};

// In the order of their first pieces.
std::vector<PieceGroup> grouped(const Pieces& pieces, Matching matching);

bool do_match(const Attributes& a, const Attributes& b, Matching matching);

}  // namespace ombre::solids
