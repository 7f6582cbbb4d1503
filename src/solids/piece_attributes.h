// Grouping of pieces with different attributes in an operation, after the thesis on multi-material OpenSCAD (2023),
// section 3.
#pragma once

#include <vector>

#include "solids/solid.h"

namespace ombre::solids {

// The attributes that keep pieces apart.
enum class Matching {
  all,       // material, part and colour
  material,  // material and part
  none,
};

// Pieces that an operation works on together. The attributes are those of the first piece that is not empty.
struct PieceGroup {
  Attributes attributes;
  std::vector<Piece> members;  // in order; some may be empty
};

// Groups pieces, in the order of the first piece of each group.
std::vector<PieceGroup> grouped(const Pieces& pieces, Matching matching);

bool do_match(const Attributes& a, const Attributes& b, Matching matching);

// True if one piece may limit the other in an intersection, a difference or a sum: no attribute that counts is set to
// one value for the one and to another value for the other. So a piece without attributes limits every piece.
bool do_agree(const Attributes& a, const Attributes& b, Matching matching);

// Returns the attributes of the first, and where it has none, those of the second.
Attributes completed(Attributes first, const Attributes& second);

}  // namespace ombre::solids
