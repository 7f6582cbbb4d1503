// Tables of mixtures over colours in sRGB.
#pragma once

#include <vector>

#include "ink/colour_mixer.h"
#include "program/field_source.h"

namespace ombre::nodes {

// Returns a source over red, green and blue from 0 to 1 in sRGB, with the channels "0", "1", ..., which interpolates
// linearly between colours. Each output has values for as many colours along each axis, of which blue varies fastest.
program::SourceField make_colour_source(std::vector<std::vector<double>> outputs);

// Returns a table of the mixer's shares. It has 33 colours along each axis.
program::SourceField make_colour_table(const ink::ColourMixer& mixer, size_t materials);

}  // namespace ombre::nodes
