// Colours by name and as #rgb, #rgba, #rrggbb and #rrggbbaa.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "solids/tree.h"

namespace ombre::lang::openscad {

// Returns nothing if the text is not a colour. Names are those of CSS (W3C, CSS Color Module Level 4); case is ignored.
std::optional<solids::Colour> colour_of(const std::string& text);

// Returns the name of a colour in CSS, else #rrggbb, or #rrggbbaa if it is not opaque.
std::string colour_name(const std::array<uint8_t, 4>& rgba);

}  // namespace ombre::lang::openscad
