// The outside of a PNG file: its signature and chunks.
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
  // Rounded to whole dots; none where one is 0.
  void add_resolution(double dots_per_metre_x, double dots_per_metre_y);

  // `type` has four letters.
  void add(std::string_view type, std::string_view data) { add(type, {data}); }
  // The data in parts.
  void add(std::string_view type, std::initializer_list<std::string_view> data);
  // Room for about so many bytes in all.
  void reserve(size_t bytes) { file_.reserve(bytes); }
  std::string take() { return std::move(file_); }

 private:
  std::string file_;
};

// Four bytes, the highest first.
std::string big_endian(uint32_t value);

}  // namespace ombre::formats
