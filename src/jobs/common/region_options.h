// Options of jobs that cut designs into regions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options/option.h"
#include "questions/region_request.h"

namespace ombre::compile {

// Parses increasing numbers such as "0.25,0.5".
std::vector<double> parse_borders(const std::string& text, const std::string& name);
inline constexpr options::Kind<std::vector<double>> rising_numbers_kind{"numbers", parse_borders};

// Parses positive numbers such as "5,0.1".
std::vector<double> parse_distances(const std::string& text, const std::string& name);
inline constexpr options::Kind<std::vector<double>> distances_kind{"numbers", parse_distances};

struct RegionOptions {
  std::optional<double> tolerance_mm, cell_mm;
  std::string by;
  int bands = 0;  // 0: not chosen
  std::vector<double> borders, within;

  // `piece` names what a region becomes, "A body"; `usual` names the default regions, and `usual_tolerance` the default
  // tolerance.
  static options::Spec<RegionOptions> options(const std::string& piece, const std::string& usual,
                                              const std::string& usual_tolerance) {
    using namespace options;
    return {option("--tolerance", &RegionOptions::tolerance_mm, kind::length,
                   "Largest distance to the design's surface; mm (default: " + usual_tolerance + ")", "MM"),
            option("--cell", &RegionOptions::cell_mm, kind::length,
                   "Edge of the smallest cells; mm (default: 4 times the tolerance)", "MM"),
            option("--by", &RegionOptions::by, kind::text,
                   piece +
                       " for the whole, for each material or named part, or for bands of a material's fraction or "
                       "an\nattribute; several names with commas: for each combination of their bands (default: " +
                       usual + ")",
                   "whole|materials|parts|NAME"),
            option("--bands", &RegionOptions::bands, kind::whole,
                   "Number of bands of equal width (default 4, of the fraction that varies most)", "N")
                .between(2, 1000),
            option("--borders", &RegionOptions::borders, rising_numbers_kind,
                   "Values at the borders of bands: fractions from 0 to 1, or values of the attribute", "V1,V2,...")
                .excludes({"--bands"}),
            option("--within", &RegionOptions::within, distances_kind,
                   "Largest distance of values from the middle of their band, for all names or one for each: as few\n"
                   "bands as that takes",
                   "V1,V2,...")
                .excludes({"--bands", "--borders"})};
  }
  bool are_chosen() const { return !by.empty() || has_bands(); }
  bool has_bands() const { return bands > 0 || !borders.empty() || !within.empty(); }
  // Returns the distance for the value `n` of those that have bands; 0 for none.
  double within_of(size_t n) const { return within.empty() ? 0 : within[within.size() > 1 ? n : 0]; }
  // Throws options::WrongValue for options that exclude each other.
  RegionRequest request() const;
};

}  // namespace ombre::compile
