// Exact voxel pitches as ratios: 600 dpi is 25.4/600 mm, never 0.0423.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ombre {

// A positive length of numerator/denominator millimetres in lowest terms.
struct Pitch {
  int64_t numerator = 1, denominator = 10;

  static std::optional<Pitch> from_ratio(int64_t numerator, int64_t denominator);
  // Reads a length in mm: "0.027", "1/3", "25.4/600", "5e-2". A decimal with few digits is exact as written. One with
  // more digits than a person would type was computed, so it becomes the simple ratio that it rounds
  // (0.08466666666666667 is 25.4/300), or stays as written if there is none.
  static std::optional<Pitch> parse(std::string_view text);
  static std::optional<Pitch> from_dpi(std::string_view dots_per_inch);
  // Returns the pitch of the shortest decimal that reads back to this double.
  static std::optional<Pitch> from_mm(double mm);

  double mm() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
  // Returns index * pitch in mm, rounded once.
  double times(double index) const { return index * static_cast<double>(numerator) / static_cast<double>(denominator); }
  double dots_per_metre() const { return 1000.0 * static_cast<double>(denominator) / static_cast<double>(numerator); }
  std::string text() const;  // "0.027" if a short decimal is exact, else "127/3000"
  bool operator==(const Pitch&) const = default;
};

}  // namespace ombre
