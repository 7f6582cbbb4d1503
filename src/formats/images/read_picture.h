// Pictures that lie on solids or are heights: PNG and JPEG.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;  // rows from the top
};

// Which way up a photograph is, of which the camera noted how it was held.
enum class Turning : uint8_t {
  as_stored,  // as textures of meshes are, whose coordinates count stored pixels
  as_seen     // as programs show it
};

// Returns the pixels of a picture; its colours are taken as sRGB, whatever its profile. Throws Error, naming `name`, if
// it is neither PNG nor JPEG, damaged, or has more than 2^27 pixels.
Picture read_picture(const std::string& name, std::string_view bytes, Turning turning);

}  // namespace ombre::formats
