// Writes the signature and chunks of a PNG file.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "formats/images/rgba.h"

namespace ombre::formats {

enum class PngColours : uint8_t { gray = 0, indexed = 3, rgba = 6 };

class PngChunks {
 public:
  PngChunks();

  void add_header(uint32_t width, uint32_t height, PngColours type, int bit_depth);
  void add_palette(std::span<const Rgba> colours);
  // Adds a resolution, rounded to integers; none if one of the numbers is 0.
  void add_resolution(double dots_per_metre_x, double dots_per_metre_y);

  // Adds a chunk; `type` has four letters.
  void add(std::string_view type, std::string_view data) { add(type, {data}); }
  // Adds a chunk whose data are given in parts.
  void add(std::string_view type, std::initializer_list<std::string_view> data);
  // Reserves memory for about this many bytes in total.
  void reserve(size_t bytes) { file_.reserve(bytes); }
  std::string take() { return std::move(file_); }

 private:
  std::string file_;
};

// Returns the number as four big-endian bytes.
std::string big_endian(uint32_t value);

}  // namespace ombre::formats
