#include "lang/edit/replacement.h"

#include <algorithm>

#include "base/system/assert.h"

namespace ombre::lang {

void sort_by_place(Replacements& replacements) { std::ranges::stable_sort(replacements, {}, &Replacement::from); }

std::string applied(std::string_view text, const Replacements& replacements) {
  std::string result;
  size_t at = 0;
  for (const Replacement& replacement : replacements) {
    ASSERT(at <= replacement.from && replacement.from <= replacement.to && replacement.to <= text.size());
    result += text.substr(at, replacement.from - at);
    result += replacement.text;
    at = replacement.to;
  }
  return result += text.substr(at);
}

Replacements inverse(std::string_view text, const Replacements& replacements) {
  Replacements result;
  size_t grown = 0, shrunk = 0;  // bytes that the replacements before have added and removed
  for (const Replacement& replacement : replacements) {
    const size_t from = replacement.from + grown - shrunk;
    result.push_back({from, from + replacement.text.size(),
                      std::string(text.substr(replacement.from, replacement.to - replacement.from))});
    grown += replacement.text.size();
    shrunk += replacement.to - replacement.from;
  }
  return result;
}

}  // namespace ombre::lang
