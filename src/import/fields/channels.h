// What solids are asked for.
#pragma once

#include <string_view>

namespace ombre::importing {

enum Channel : int { inside_channel = 0, distance_channel = 1 };

// -1: none of that name.
inline int channel_of(std::string_view name) {
  return name == "inside" ? inside_channel : name == "distance" ? distance_channel : -1;
}

}  // namespace ombre::importing
