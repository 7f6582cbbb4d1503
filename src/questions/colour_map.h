// Maps values to colours.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/interval.h"
#include "design/materials.h"
#include "program/field.h"

namespace ombre::compile {

// Nine colours from the least value to the greatest. Between them linear light is interpolated.
struct Palette {
  std::string_view name;
  std::array<design::Rgba, 9> colours;
};
// Returns all palettes. The first is the default: viridis, from dark blue over green to yellow, even in lightness.
std::span<const Palette> palettes();
std::vector<std::string> palette_names();
const Palette* palette_called(std::string_view name);  // null if there is none

// Colours that are easy to tell apart, also with colour blindness: a light gray for no label, then those of Okabe and
// Ito (2008). Labels take them in turn.
std::span<const design::Rgba> label_colours();
design::Rgba label_colour(size_t label);  // 0: no label

// Returns the colour of a share from 0 to 1.
design::Rgba map_colour(double share, const Palette& palette = palettes().front());

// Linear red, green and blue of a value: the first colour up to range.lo, the last from range.hi on.
std::array<program::Field, 3> mapped_colour(program::Field value, Interval range,
                                            const Palette& palette = palettes().front());

}  // namespace ombre::compile
