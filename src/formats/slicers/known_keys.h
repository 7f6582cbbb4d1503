// The settings that slicers know for bodies of an object, and for the object as a whole. The lists are those of
// PrusaSlicer 2.9, Bambu Studio 2.8 and OrcaSlicer 2.4: the members of PrintRegionConfig and PrintObjectConfig in
// PrintConfig.hpp of each.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/slicers/flavour.h"

namespace ombre::formats {

enum class KeyScope : uint8_t {
  body,    // each body of an object has its own value
  object,  // one value holds for the whole object, or for a range of heights if it is layer_height
};

// Numbers that a setting takes.
struct ValueLimits {
  bool is_whole = false, takes_percent = false;
  double least = 0, most = std::numeric_limits<double>::infinity();
  bool is_above_least = false;
};

// A kind of number that settings take.
struct ValueKind {
  std::string_view name, example;  // "a whole number, 0 or more", "3"
  ValueLimits limits;

  // True for a number that the setting takes with this unit behind it, "%" or nothing.
  bool takes(double number, std::string_view unit) const;
};

// Returns nothing for keys that the program does not know. Generic files have PrusaSlicer's keys.
std::optional<KeyScope> scope_of(SlicerFlavour flavour, std::string_view key);
// Returns the kind of numbers that the setting takes, or null if it takes words, or is not known.
const ValueKind* kind_of(SlicerFlavour flavour, std::string_view key);
std::vector<std::string> known_keys(SlicerFlavour flavour);

}  // namespace ombre::formats
