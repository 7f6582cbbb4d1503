// A layer as an RGBA image, by libpng as it is out of the box.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace baseline {

using Colour = std::array<uint8_t, 4>;

// Writes rows of `width` materials, each shown in its colour; returns the size of the file.
size_t write_png(const std::string& path, const std::vector<uint8_t>& voxels, size_t width,
                 const std::vector<Colour>& colours);

}  // namespace baseline
