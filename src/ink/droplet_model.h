// Predicts what mixtures of droplets show, from measured patches.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ink/colour_mixer.h"
#include "ink/profile.h"

namespace ombre::ink {

// A patch of known shares, and what was measured on it.
struct Patch {
  std::vector<double> shares;  // of the inks, and last of the material that takes what they leave; their sum is 1
  Lab colour;                  // relative to a perfect diffuser under D50
};

// How well the model predicts patches that it does not know: each from all others. CIEDE2000.
struct ModelError {
  double mean = 0, most_of_95_percent = 0, worst = 0;
  size_t worst_patch = 0;
};

// Light spreads in a print before it leaves. Therefore the mean over the droplets is that of powers of X, Y and Z (J.
// A. C. Yule and W. J. Nielsen, 1951), whose exponent 1/n suits the patches best. What this mean misses at the patches
// is interpolated between them with weights of 1/distance^4 (D. Shepard, 1968) and added.
class DropletModel {
 public:
  // There is a patch of each material alone.
  explicit DropletModel(std::vector<Patch> patches);

  // Returns the number of a material that no patch has alone.
  static std::optional<size_t> missing_alone(const std::vector<Patch>& patches);

  size_t materials() const { return alone_.size(); }
  double n() const { return n_; }
  const Lab& rest() const { return patches_[alone_.back()].colour; }
  // Returns what a mixture shows. It is what was measured at the patches.
  Lab colour(std::span<const double> shares) const;
  // Returns the shares that show the colour with the least graininess. If none do, the shares are those of the nearest
  // colour in L*a*b*; the search for them begins at the shares `near`, if there are any, and at others.
  std::vector<double> shares(const Lab& wanted, const std::vector<double>& near = {}) const;
  ModelError error() const;

 private:
  Lab mean_of_light(std::span<const double> shares) const;
  Vec3 powers_of(const Lab& lab) const;
  Lab corrected(std::span<const double> shares, std::optional<size_t> left_out) const;
  std::vector<double> nearest(const Lab& wanted, std::vector<std::vector<double>> starts) const;
  void fit();

  std::vector<Patch> patches_;
  std::vector<size_t> alone_;  // the patch of each material alone
  double n_ = 1;
  std::vector<Vec3> light_;  // powers of X, Y and Z of each material alone
  std::vector<Lab> misses_;  // at each patch
  std::optional<ColourMixer> mixer_;
};

// Returns the tables of a profile of the model's inks; the rest is the medium.
ProfileTables tables_of(const DropletModel& model, const std::string& description, int threads = 0);

}  // namespace ombre::ink
