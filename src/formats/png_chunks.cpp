#include "formats/png_chunks.h"

#include <libdeflate.h>

#include "base/assert.h"

namespace ombre::formats {

std::string big_endian(uint32_t value) {
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

PngChunks::PngChunks() : file_("\x89PNG\r\n\x1A\n") {}

void PngChunks::add(std::string_view type, std::initializer_list<std::string_view> data) {
  size_t size = 0;
  uint32_t sum = libdeflate_crc32(0, type.data(), type.size());
  for (const std::string_view part : data) {
    size += part.size();
    if (!part.empty()) sum = libdeflate_crc32(sum, part.data(), part.size());
  }
  ASSERT(type.size() == 4 && size < size_t{1} << 31);
  file_ += big_endian(static_cast<uint32_t>(size));
  file_ += type;
  for (const std::string_view part : data) file_ += part;
  file_ += big_endian(sum);
}

}  // namespace ombre::formats
