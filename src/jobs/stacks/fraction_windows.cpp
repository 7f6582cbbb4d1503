#include "jobs/stacks/fraction_windows.h"

#include <algorithm>
#include <cmath>

namespace ombre::compile {
namespace {

constexpr int64_t window_side = 16;
constexpr double least_variance = 5;  // the sum of draws is about normal from here on

// Says whether a sum of squares of `count` standard normal numbers is too large, by the approximation of E. B. Wilson
// and M. M. Hilferty ("The distribution of chi-square", Proc. Natl. Acad. Sci. 17, 1931).
bool is_too_large(double square, uint64_t count) {
  constexpr double most_deviations = 4.7534;  // of a normal number, with the probability chi_square_level
  const double part = 2 / (9 * static_cast<double>(count));
  return std::cbrt(square / static_cast<double>(count)) > 1 - part + most_deviations * std::sqrt(part);
}

}  // namespace

FractionWindows::FractionWindows(const std::vector<SliceMaterial>& materials, const Appearance& appearance)
    : materials_(materials), appearance_(appearance), sums_(materials.size()), seen_as_(materials.size()) {
  for (size_t m = 0; m < materials.size(); ++m)
    for (size_t other = 0; other < materials.size(); ++other)
      if (appearance.of(materials[other].id) == materials[m].id) seen_as_[m].push_back(other);
}

void FractionWindows::add(int64_t width, const Shown& shown, const std::vector<voxel::ChannelPixels>& fractions) {
  const int64_t height = static_cast<int64_t>(shown.size()) / width;
  const auto share = [&](size_t material, size_t n) {
    double sum = 0;
    for (const size_t m : seen_as_[material])
      sum += std::get<voxel::Raster<uint16_t>>(fractions[m]).values[n] / 65535.0;
    return std::min(sum, 1.0);
  };
  for (int64_t j0 = 0; j0 < height; j0 += window_side) {
    for (int64_t i0 = 0; i0 < width; i0 += window_side) {
      bool is_mixed = false;
      for (size_t m = 0; m < materials_.size(); ++m) {
        double expected = 0, variance = 0, found = 0;
        for (int64_t j = j0; j < std::min(j0 + window_side, height); ++j) {
          for (int64_t i = i0; i < std::min(i0 + window_side, width); ++i) {
            const auto n = static_cast<size_t>(j * width + i);
            const double fraction = share(m, n);
            expected += fraction;
            variance += fraction * (1 - fraction);
            found += shown[n] != 0 && shown[n] == appearance_.of(materials_[m].id) ? 1 : 0;
          }
        }
        expected_changes_ += variance;
        if (variance < least_variance) continue;
        is_mixed = true;
        sums_[m].square += (found - expected) * (found - expected) / variance;
        ++sums_[m].count;
      }
      windows_ += is_mixed ? 1 : 0;
    }
  }
}

std::optional<std::string> FractionWindows::misfit() const {
  for (size_t m = 0; m < materials_.size(); ++m)
    if (sums_[m].count > 0 && is_too_large(sums_[m].square, sums_[m].count)) return materials_[m].name;
  return std::nullopt;
}

}  // namespace ombre::compile
