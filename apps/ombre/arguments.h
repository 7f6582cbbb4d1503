// Values of options: lengths as exact text, resolutions, sizes of memory.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/box.h"
#include "base/pitch.h"

namespace ombre::cli {

using Pitches = std::array<std::optional<Pitch>, 3>;

// Each throws WrongArgument, naming `option`, with an example of what to write.

// "0.1" for all axes, or "x,y,z"; millimetres.
Pitches parse_voxel(const std::string& text);
// "600" for x and y, "600,300" or "600,300,940".
Pitches parse_dpi(const std::string& text);
Pitch parse_layer_height(const std::string& text);
// "2G", "512M", "1.5GiB"; at least a megabyte.
size_t parse_memory(const std::string& text);
// --box "x0,y0,z0,x1,y1,z1", with a size along each axis; millimetres.
Box parse_box(const std::string& text);
// "1,2.5,-3"; empty where something is no finite number.
std::vector<double> parse_numbers(const std::string& text);

}  // namespace ombre::cli
