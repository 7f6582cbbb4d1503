// Changes of a text, as ranges that are replaced.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::lang {

// Bytes [from, to) of a text, and what takes their place.
struct Replacement {
  size_t from = 0, to = 0;
  std::string text;

  bool operator==(const Replacement&) const = default;
};

// Replacements of one text. They do not overlap, and those at the same place stand in the order of the result.
using Replacements = std::vector<Replacement>;

// Sorts replacements by their places.
void sort_by_place(Replacements& replacements);
// Returns the text after the replacements, which are sorted.
std::string applied(std::string_view text, const Replacements& replacements);
// Returns the replacements that turn the changed text back into `text`.
Replacements inverse(std::string_view text, const Replacements& replacements);

}  // namespace ombre::lang
