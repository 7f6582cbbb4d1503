// Reads arrays of numbers in VTK's XML files: as text, as base64, or as raw bytes after the XML, optionally compressed
// by zlib, LZ4 or LZMA.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/containers/xml_file.h"

namespace ombre::formats {

// A file with the root element VTKFile. Errors are reported, and DesignError is thrown.
class VtkArrays {
 public:
  struct Kind {
    size_t bytes = 0;
    char family = ' ';  // f, i or u for float, signed and unsigned
  };
  struct Parts {
    std::string xml;
    std::string_view appended;  // the appended data after the underscore
    bool is_base64 = false;
  };

  // Parses a file; the bytes must outlive this object.
  VtkArrays(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

  const XmlFile& file() const { return file_; }
  // Reads the byte order, the size of headers and the compression from the root element.
  void read_settings(pugi::xml_node root);

  // Returns the type of an array's numbers.
  Kind kind_of(pugi::xml_node array) const;
  // Returns `count` numbers of any type and in any form.
  std::vector<double> numbers(pugi::xml_node array, uint64_t count) const;
  // Returns the little-endian bytes of `count` numbers that are not text.
  std::string bytes_of(pugi::xml_node array, uint64_t count) const;
  // Returns these bytes as a part of the file if they can be used in place, else null.
  std::optional<std::string_view> bytes_in_file(pugi::xml_node array, uint64_t count) const;

 private:
  std::vector<double> numbers_in_text(pugi::xml_node array, uint64_t count) const;
  [[noreturn]] void fail_short(pugi::xml_node array, uint64_t count) const;
  std::string_view appended_at(pugi::xml_node array) const;
  std::string appended_bytes(pugi::xml_node array, uint64_t size) const;
  size_t header_bytes() const;
  uint64_t header(std::string_view bytes, size_t n) const;
  void check_header(pugi::xml_node array, std::string_view text, bool is_base64, uint64_t size) const;
  std::string take(pugi::xml_node array, std::string_view& text, bool is_base64, uint64_t size) const;
  std::string array_bytes(pugi::xml_node array, std::string_view text, bool is_base64, uint64_t size) const;
  std::string unpacked_blocks(pugi::xml_node array, std::string_view text, bool is_base64, uint64_t size) const;
  std::string unpacked_block(pugi::xml_node array, std::string_view packed, uint64_t size) const;

  Parts parts_;
  XmlFile file_;
  std::string compressor_;  // empty if numbers are not packed; it does not matter for numbers as text
  bool is_swapped_ = false, has_long_headers_ = false;
};

}  // namespace ombre::formats
