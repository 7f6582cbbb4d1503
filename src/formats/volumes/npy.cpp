#include "formats/volumes/npy.h"

#include "base/system/assert.h"

namespace ombre::formats {

std::string npy_header(std::string_view type, const std::vector<int64_t>& shape) {
  std::string text = "{'descr': '" + std::string(type) + "', 'fortran_order': False, 'shape': (";
  for (const int64_t length : shape) text += std::to_string(length) + ", ";
  text += "), }";
  // The header is padded so that the numbers begin at a multiple of 64 bytes, after a line end.
  constexpr size_t before = 10, unit = 64;
  text.append((unit - (before + text.size() + 1) % unit) % unit, ' ');
  text += '\n';
  ASSERT(text.size() < 65536);
  std::string header("\x93NUMPY\x01\x00", 8);
  header += static_cast<char>(text.size() & 0xFF);
  header += static_cast<char>(text.size() >> 8);
  return header + text;
}

}  // namespace ombre::formats
