#include "voxel/dither.h"

#include <algorithm>

namespace ombre::voxel {

const std::vector<std::string>& dither_names() {
  static const std::vector<std::string> names{"stochastic", "blue-noise", "diffusion", "threshold"};
  return names;
}

std::string_view name(Dither dither) { return dither_names()[static_cast<size_t>(dither)]; }

std::optional<Dither> dither(std::string_view name) {
  const auto& names = dither_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Dither>(found - names.begin());
}

}  // namespace ombre::voxel
