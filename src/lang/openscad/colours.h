// Names of colours, and colours as #rgb, #rgba, #rrggbb and #rrggbbaa.
#pragma once

#include <optional>
#include <string>

#include "solids/tree.h"

namespace ombre::lang::openscad {

// Nothing where the text names no colour. Names are those of CSS (W3C, CSS Color Module Level 4), without regard to
// case.
std::optional<solids::Colour> colour_of(const std::string& text);

}  // namespace ombre::lang::openscad
