// What the kinds of volumes are that Slic3r and PrusaSlicer write into 3MF and AMF files.
#pragma once

#include <string_view>

namespace ombre::formats {

inline constexpr std::string_view negative_volume = "NegativeVolume";

// False for modifiers, for places with or without supports, and for what is taken away from other volumes. Files of
// older versions have no type and mark modifiers by "1".
inline bool is_solid_volume(std::string_view type, std::string_view modifier) {
  return (type.empty() || type == "ModelPart") && modifier != "1";
}

}  // namespace ombre::formats
