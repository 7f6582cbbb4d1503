// Colours of files.
#include "formats/images/rgba.h"

#include <charconv>

namespace ombre::formats {

std::optional<Rgba> parse_colour(std::string_view text) {
  Rgba colour{0, 0, 0, 255};
  if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
  for (size_t i = 0; 2 * i + 1 < text.size(); ++i) {
    const char* const digits = text.data() + 1 + 2 * i;
    if (std::from_chars(digits, digits + 2, colour[i], 16).ptr != digits + 2) return std::nullopt;
  }
  return colour;
}

}  // namespace ombre::formats
