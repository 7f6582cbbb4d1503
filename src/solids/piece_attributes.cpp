#include "solids/piece_attributes.h"

#include <algorithm>

namespace ombre::solids {

bool do_match(const Attributes& a, const Attributes& b, Matching matching) {
  switch (matching) {
    case Matching::all:
      return a == b;
    case Matching::material:
      return a.material == b.material && a.part == b.part;
    case Matching::none:
      break;
  }
  return true;
}

bool do_agree(const Attributes& a, const Attributes& b, Matching matching) {
  if (matching == Matching::none) return true;
  const auto differ = [](const std::string& first, const std::string& second) {
    return !first.empty() && !second.empty() && first != second;
  };
  if (differ(a.material, b.material) || differ(a.part, b.part)) return false;
  return matching == Matching::material || !a.colour || !b.colour || *a.colour == *b.colour;
}

Attributes completed(Attributes first, const Attributes& second) {
  if (first.material.empty()) first.material = second.material;
  if (first.part.empty()) first.part = second.part;
  if (!first.colour) first.colour = second.colour;
  return first;
}

std::vector<PieceGroup> grouped(const Pieces& pieces, Matching matching) {
  std::vector<PieceGroup> groups;
  for (const Piece& piece : pieces) {
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const PieceGroup& g) { return do_match(g.attributes, piece.attributes, matching); });
    if (group == groups.end()) {
      groups.push_back({piece.attributes, {piece}});
      continue;
    }
    const bool was_empty = std::all_of(group->members.begin(), group->members.end(),
                                       [](const Piece& member) { return member.dimension() == 0; });
    if (was_empty && piece.dimension() != 0) group->attributes = piece.attributes;
    group->members.push_back(piece);
  }
  return groups;
}

}  // namespace ombre::solids
