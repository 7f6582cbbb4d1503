// The outside of a PNG file: its signature and chunks.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ombre::formats {

class PngChunks {
 public:
  PngChunks();

  // `type` has four letters.
  void add(std::string_view type, const uint8_t* data, size_t size);
  void add(std::string_view type, std::string_view data);
  std::string take() { return std::move(file_); }

 private:
  std::string file_;
};

// Four bytes, the highest first.
std::string big_endian(uint32_t value);

}  // namespace ombre::formats
