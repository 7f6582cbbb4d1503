// Reads the header of a PLY file, which lists the elements and their properties.
#include "formats/mesh/ply_header.h"

#include <array>

namespace ombre::formats {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array<TypeName, 16> type_names{{{"char", PlyType::int8},
                                               {"uchar", PlyType::uint8},
                                               {"short", PlyType::int16},
                                               {"ushort", PlyType::uint16},
                                               {"int", PlyType::int32},
                                               {"uint", PlyType::uint32},
                                               {"float", PlyType::float32},
                                               {"double", PlyType::float64},
                                               {"int8", PlyType::int8},
                                               {"uint8", PlyType::uint8},
                                               {"int16", PlyType::int16},
                                               {"uint16", PlyType::uint16},
                                               {"int32", PlyType::int32},
                                               {"uint32", PlyType::uint32},
                                               {"float32", PlyType::float32},
                                               {"float64", PlyType::float64}}};

PlyType read_type(TextScanner& scanner) {
  const std::string_view word = scanner.word_in_line();
  for (const TypeName& known : type_names)
    if (known.name == word) return known.type;
  scanner.fail_at_word("expected the type of a property, found " + quoted(word),
                       "types are char, uchar, short, ushort, int, uint, float, double");
}

PlyProperty read_property(TextScanner& scanner) {
  PlyProperty property;
  TextScanner ahead(scanner);
  if (ahead.word_in_line() == "list") {
    scanner.word_in_line();
    property.is_list = true;
    property.count_type = read_type(scanner);
    if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
      scanner.fail_at_word("the length of a list must be a whole number");
  }
  property.type = read_type(scanner);
  property.name = scanner.word_in_line();
  if (property.name.empty()) scanner.fail_here("expected the name of a property, but the line ends here");
  return property;
}

PlyEncoding read_encoding(TextScanner& scanner) {
  const std::string_view word = scanner.word_in_line();
  if (word == "ascii") return PlyEncoding::ascii;
  if (word == "binary_little_endian") return PlyEncoding::little_endian;
  if (word == "binary_big_endian") return PlyEncoding::big_endian;
  scanner.fail_at_word("expected ascii, binary_little_endian or binary_big_endian, found " + quoted(word));
}

PlyElement read_element(TextScanner& scanner) {
  PlyElement element;
  element.name = scanner.word_in_line();
  if (scanner.at_line_end()) scanner.fail_here("expected an element's name and count, but the line ends here");
  element.count = scanner.count("the count of an element");
  return element;
}

}  // namespace

size_t byte_size(PlyType type) {
  constexpr std::array<size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<size_t>(type)];
}

size_t least_bytes(const PlyElement& element, PlyEncoding encoding) {
  if (encoding == PlyEncoding::ascii) return 2 * element.properties.size();
  size_t bytes = 0;
  for (const PlyProperty& property : element.properties)
    bytes += byte_size(property.is_list ? property.count_type : property.type);
  return bytes;
}

PlyHeader read_ply_header(TextScanner& scanner) {
  PlyHeader header;
  if (scanner.word() != "ply") scanner.fail_at_word("a PLY file begins with the word ply");
  scanner.next_line();
  bool has_encoding = false;
  for (;;) {
    if (scanner.at_end()) scanner.fail_here("this PLY is cut short: its header has no end_header");
    const std::string_view keyword = scanner.word_in_line();
    if (keyword == "format") {
      header.encoding = read_encoding(scanner);
      has_encoding = true;
    } else if (keyword == "element") {
      header.elements.push_back(read_element(scanner));
    } else if (keyword == "property") {
      if (header.elements.empty()) scanner.fail_at_word("a property comes before the first element");
      header.elements.back().properties.push_back(read_property(scanner));
    } else if (keyword == "end_header") {
      break;
    } else if (keyword != "comment" && keyword != "obj_info") {
      scanner.fail_at_word("a PLY header has no line that begins with " + quoted(keyword),
                           "it has format, element, property, comment, obj_info and end_header");
    }
    scanner.next_line();
  }
  if (!has_encoding) scanner.fail_at_word("the header ends without a format line");
  scanner.next_line();
  return header;
}

}  // namespace ombre::formats
