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

void PngChunks::add(std::string_view type, const uint8_t* data, size_t size) {
  ASSERT(type.size() == 4 && size < size_t{1} << 31);
  const uint32_t type_sum = libdeflate_crc32(0, type.data(), type.size());
  const uint32_t sum = size > 0 ? libdeflate_crc32(type_sum, data, size) : type_sum;
  file_ += big_endian(static_cast<uint32_t>(size));
  file_ += type;
  file_.append(reinterpret_cast<const char*>(data), size);
  file_ += big_endian(sum);
}

void PngChunks::add(std::string_view type, std::string_view data) {
  add(type, reinterpret_cast<const uint8_t*>(data.data()), data.size());
}

}  // namespace ombre::formats
