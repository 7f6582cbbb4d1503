// Measured patches in a CSV file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ink/droplet_model.h"

namespace ombre::ink {

struct PatchTable {
  std::vector<std::string> materials;  // the inks in their order, and last the material that takes what they leave
  std::vector<Patch> patches;          // patches with equal shares are one, which has the mean of their colours
};

// Reads lines of numbers below a line of names: a column for each material with its share, and L, a and b. A column
// called "patch" is ignored, as are lines that begin with #. Throws Error with the line of what is wrong: shares that
// do not add up to 1, a material that no patch has alone, less than two materials or more than nine.
PatchTable read_patches(const std::string& name, std::string_view text);

}  // namespace ombre::ink
