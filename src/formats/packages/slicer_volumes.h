// Kinds of volumes that Slic3r and PrusaSlicer write into 3MF and AMF files.
#pragma once

#include <string_view>

namespace ombre::formats {

inline constexpr std::string_view negative_volume = "NegativeVolume";

// Returns false for modifiers, for regions with or without supports, and for volumes subtracted from others. Files of
// older versions have no type and mark modifiers by "1".
inline bool is_solid_volume(std::string_view type, std::string_view modifier) {
  return (type.empty() || type == "ModelPart") && modifier != "1";
}

}  // namespace ombre::formats
