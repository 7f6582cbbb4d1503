// Values of options, by the names that commands have for them.
#pragma once

#include "options/option_values.h"

namespace ombre::cli {

using options::parse_box;
using options::parse_dpi;
using options::parse_layer_height;
using options::parse_memory;
using options::parse_numbers;
using options::parse_voxel;

}  // namespace ombre::cli
