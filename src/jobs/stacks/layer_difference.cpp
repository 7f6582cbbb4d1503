#include "jobs/stacks/layer_difference.h"

#include <algorithm>

namespace ombre::compile {
namespace {

size_t differing(const Shown& a, const Shown& b) {
  size_t count = 0;
  for (size_t n = 0; n < a.size() && n < b.size(); ++n) count += a[n] != b[n];
  return count;
}

Shown mirrored(const Shown& shown, int64_t width, bool along_x) {
  Shown result(shown.size());
  const int64_t height = static_cast<int64_t>(shown.size()) / width;
  for (int64_t j = 0; j < height; ++j)
    for (int64_t i = 0; i < width; ++i) {
      const int64_t from = along_x ? j * width + width - 1 - i : (height - 1 - j) * width + i;
      result[static_cast<size_t>(j * width + i)] = shown[static_cast<size_t>(from)];
    }
  return result;
}

// True if voxels differ, but none between void and something.
bool has_shape_of(const Shown& shown, const Shown& expected) {
  for (size_t n = 0; n < shown.size(); ++n)
    if ((shown[n] == 0) != (expected[n] == 0)) return false;
  return true;
}

}  // namespace

LikelyCause likely_cause(const Shown& shown, const Shown& expected, int64_t width,
                         const std::vector<int64_t>& other_layers, const ExpectedLayer& expected_layer,
                         double changes) {
  const size_t now = differing(shown, expected);
  // A cause leaves at most rounding, and much less than there is without it.
  const auto explains = [&](size_t left) { return 10 * left <= now && 1000 * left <= shown.size(); };
  for (const bool along_x : {true, false})
    if (explains(differing(mirrored(shown, width, along_x), expected)))
      return {"mirrored", std::string("the layer is mirrored along ") + (along_x ? "x" : "y")};
  for (const int64_t other : other_layers)
    if (explains(differing(shown, expected_layer(other))))
      return {"exchanged", "it shows what belongs into layer " + std::to_string(other)};
  constexpr size_t least_changes = 20;
  if (now >= least_changes && static_cast<double>(now) > 0.5 * changes && has_shape_of(shown, expected))
    return {"seed", "its shape is right, so it is dithered with another seed or rule, or of other mixtures"};
  return {"voxels", ""};
}

}  // namespace ombre::compile
