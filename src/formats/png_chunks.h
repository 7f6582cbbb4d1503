// The outside of a PNG file: its signature and chunks.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace ombre::formats {

class PngChunks {
 public:
  PngChunks();

  // `type` has four letters.
  void add(std::string_view type, std::string_view data) { add(type, {data}); }
  // The data in parts.
  void add(std::string_view type, std::initializer_list<std::string_view> data);
  std::string take() { return std::move(file_); }

 private:
  std::string file_;
};

// Four bytes, the highest first.
std::string big_endian(uint32_t value);

}  // namespace ombre::formats
