// Compares the colours that a design asks for with those that its inks show.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibration/calibration.h"
#include "design/materials.h"
#include "ink/profile.h"
#include "questions/sampler.h"

namespace ombre::compile {

// Differences are those of CIEDE2000. Means and shares are over the part's volume.
struct ColourIntent {
  std::string attribute, by, intent;
  uint64_t points = 0;  // with colours that are compared
  double mean = 0, most_of_95_percent = 0, worst = 0;
  Vec3 worst_mm, worst_srgb;
  ink::Lab worst_wanted, worst_given;
  double share_out_of_gamut = 0;  // farther than gamut_tolerance from every colour of the inks
  double share_divided = 0;       // where the profile's shares add up to more than 1
  bool knows_materials = true;    // false where some of the part has materials that are no inks
};

// The least difference that counts as out of gamut: about what is just visible side by side.
inline constexpr double gamut_tolerance = 2;

// The colours of points that a sampler gave, and what its fractions show.
class ColourSurvey {
 public:
  // Returns nothing if the design does not give the colours, or lacks the materials.
  static std::optional<ColourSurvey> of(const calibration::Calibration& calibration,
                                        const std::vector<Sampler::Column>& columns,
                                        const design::MaterialTable& materials);

  // Adds points of the part, at which `values` has the sampler's columns. Sets flags[n] of the points that are inside
  // to 1, or to 2 if their colour is out of gamut.
  void take(const std::vector<std::vector<double>>& values, const std::vector<Vec3>& places, int threads,
            std::vector<uint8_t>& flags);
  ColourIntent finished();

 private:
  void compare(const std::vector<Vec3>& srgb, const std::vector<double>& shares, const std::vector<Vec3>& places,
               int threads);

  const calibration::Calibration* calibration_ = nullptr;
  ink::Profile profile_;
  std::array<size_t, 3> colour_{};         // columns of red, green and blue
  std::vector<std::vector<size_t>> inks_;  // columns of each ink's materials
  std::vector<size_t> rest_, clear_;
  std::vector<float> differences_;
  uint64_t out_of_gamut_ = 0, divided_ = 0;
  double sum_ = 0;
  ColourIntent intent_;
};

}  // namespace ombre::compile
