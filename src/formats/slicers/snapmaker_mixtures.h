// The mixed filaments of Snapmaker Orca and FullSpectrum, as a text of their projects.
#pragma once

#include <span>
#include <string>

#include "formats/mesh/slicer_project.h"

namespace ombre::formats {

// A pattern names the third of three filaments by one digit.
inline constexpr uint32_t most_in_pattern = 9;

// Returns the setting mixed_filament_definitions: a row for each mixture of two or three filaments, in the order of
// their extruders, with semicolons between them, as MixedFilamentManager of these programs reads it
// (github.com/Snapmaker/OrcaSlicer and github.com/ratdoux/OrcaSlicer-FullSpectrum, src/libslic3r/MixedFilament.cpp,
// 2026). Mixtures are numbered after the filaments, in the order of the rows. The pattern of a row says which of its
// filaments each layer of a cycle has, so that the shares of layers are exact. In it 1 and 2 stand for the first two
// filaments of the row, 3 to 9 for the filament of this number.
std::string snapmaker_mixtures(std::span<const FilamentMixture> mixtures);

}  // namespace ombre::formats
