// Channels of solids.
#pragma once

#include <string_view>

namespace ombre::importing {

enum Channel : int { inside_channel = 0, distance_channel = 1 };

// Returns the channel of a name, or -1 if there is none.
inline int channel_of(std::string_view name) {
  return name == "inside" ? inside_channel : name == "distance" ? distance_channel : -1;
}

}  // namespace ombre::importing
