// Compares the voxels of dithered layers with their mixtures, window by window, by a chi-square test.
//
// A window of n voxels with fractions f of a material has sum(f) voxels of it, with a variance of sum(f * (1 - f)) if
// each voxel is drawn by itself. Blue noise and diffusion have less, so that the test holds for them, too.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jobs/stacks/shown_layer.h"

namespace ombre::compile {

// A wrong verdict about right layers has about this probability for each material.
inline constexpr double chi_square_level = 1e-6;

class FractionWindows {
 public:
  FractionWindows(const std::vector<SliceMaterial>& materials, const Appearance& appearance);

  // Adds a layer of a width, with the fractions of each material in 1/65535.
  void add(int64_t width, const Shown& shown, const std::vector<voxel::ChannelPixels>& fractions);

  uint64_t windows() const { return windows_; }
  // Returns the voxels that are expected to differ if the layers are dithered anew by independent draws.
  double expected_changes() const { return expected_changes_; }
  // Returns the name of a material whose numbers of voxels do not fit its fractions; nothing if all fit.
  std::optional<std::string> misfit() const;

 private:
  struct Sum {
    double square = 0;
    uint64_t count = 0;  // windows in which the material is mixed
  };

  const std::vector<SliceMaterial>& materials_;
  const Appearance& appearance_;
  std::vector<Sum> sums_;
  std::vector<std::vector<size_t>>
      seen_as_;  // for each material those with its pixels; none if it has those of another
  uint64_t windows_ = 0;
  double expected_changes_ = 0;
};

}  // namespace ombre::compile
