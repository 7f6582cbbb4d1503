// Reads the header of a PLY file, which lists the elements and their properties.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/containers/text_scanner.h"

namespace ombre::formats {

enum class PlyEncoding { ascii, little_endian, big_endian };
enum class PlyType : uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  // for lists
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
};

size_t byte_size(PlyType type);
// Returns the least size of an element: with empty lists, and numbers in text of one digit and a blank.
size_t least_bytes(const PlyElement& element, PlyEncoding encoding);

// Reads the header; leaves the scanner at the first byte of the first element. Errors are reported, and DesignError is
// thrown.
PlyHeader read_ply_header(TextScanner& scanner);

}  // namespace ombre::formats
