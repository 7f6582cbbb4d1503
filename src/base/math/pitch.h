// Exact voxel pitches: 600 dpi is 25.4/600 mm as a ratio, never 0.0423.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ombre {

// A positive length of numerator/denominator millimetres, in lowest terms.
struct Pitch {
  int64_t numerator = 1, denominator = 10;

  static std::optional<Pitch> from_ratio(int64_t numerator, int64_t denominator);
  // The decimal digits as written are exact ("0.027", "1/3", "25.4/600", "5e-2"). What has more digits than a person
  // writes was computed: it is the simple ratio that it is but for rounding (0.08466666666666667 is 25.4/300), if there
  // is one, or else as it stands.
  static std::optional<Pitch> parse(std::string_view text);
  static std::optional<Pitch> from_dpi(std::string_view dots_per_inch);
  // Takes the shortest decimal that gives this double.
  static std::optional<Pitch> from_mm(double mm);

  double mm() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
  // index * pitch, rounded once.
  double times(double index) const { return index * static_cast<double>(numerator) / static_cast<double>(denominator); }
  double dots_per_metre() const { return 1000.0 * static_cast<double>(denominator) / static_cast<double>(numerator); }
  std::string text() const;  // "0.027" where a short decimal is exact, else "127/3000"
  bool operator==(const Pitch&) const = default;
};

}  // namespace ombre
