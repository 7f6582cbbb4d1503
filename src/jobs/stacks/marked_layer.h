// Draws a layer pale, with some of its voxels marked.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "formats/images/rgba.h"
#include "voxel/lattice.h"

namespace ombre::compile {

// The colours of flagged voxels, by their flags from 1 on.
inline constexpr std::array<formats::Rgba, 4> mark_colours{
    {{0, 0, 0, 0}, {214, 40, 40, 255}, {35, 120, 220, 255}, {240, 150, 0, 255}}};

// Returns a PNG file of a layer, at most 800 pixels wide and high, in true proportions. A flag shows however small it
// is. `colour` gives the colours of voxels, x fastest; row 0 has the least y and is the lowest one in the picture.
std::string marked_layer(const voxel::Lattice& lattice, const std::function<formats::Rgba(size_t voxel)>& colour,
                         const std::vector<uint8_t>& flags);

}  // namespace ombre::compile
