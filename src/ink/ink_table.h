// Shares of inks over a grid of colours, so that each voxel costs an interpolation.
#pragma once

#include <span>
#include <vector>

#include "ink/profile.h"

namespace ombre::ink {

// Droplets share the room of a voxel: where the shares of a colour add up to more than 1, each is divided by their sum,
// which keeps their proportions, and nothing is left for the rest. Returns the sum before.
double divide_above_one(std::span<double> shares);
// Does so for each colour, which has `channels` shares.
void divide_above_one(std::span<double> shares, size_t channels);

struct InkTable {
  static constexpr size_t steps = 33;  // colours along each of red, green and blue, from 0 to 1 in sRGB
  // The table has a list of all colours for each ink, with its share of them, and then one with the CIEDE2000
  // difference of what they show; blue varies fastest.
  std::vector<std::vector<double>> values;
  // Greatest sum of the profile's shares, before they are divided.
  double most_ink = 0;
  // CIEDE2000 difference between what interpolated shares and those of the profile show, in the middle between the
  // grid's colours, where it is greatest.
  double mean_error = 0, worst_error = 0;

  size_t inks() const { return values.size() - 1; }
};

// Throws Error as the functions of profiles do.
InkTable make_ink_table(const Profile& profile, const Rendering& rendering, int threads = 0);

}  // namespace ombre::ink
