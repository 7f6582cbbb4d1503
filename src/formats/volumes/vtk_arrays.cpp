#ifdef OMBRE_3MF

#include "formats/volumes/vtk_arrays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/containers/base64.h"
#include "formats/containers/block_packing.h"
#include "formats/containers/text_scanner.h"
#include "formats/volumes/volume_packing.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

static_assert(std::endian::native == std::endian::little, "numbers are turned round for others alone");

constexpr uint64_t most_array_bytes = uint64_t{16} << 30;  // after decompression

std::optional<VtkArrays::Kind> number_kind(std::string_view type) {
  static const std::map<std::string_view, VtkArrays::Kind> kinds{
      {"Float32", {4, 'f'}}, {"Float64", {8, 'f'}}, {"Int8", {1, 'i'}},   {"Int16", {2, 'i'}},  {"Int32", {4, 'i'}},
      {"Int64", {8, 'i'}},   {"UInt8", {1, 'u'}},   {"UInt16", {2, 'u'}}, {"UInt32", {4, 'u'}}, {"UInt64", {8, 'u'}}};
  const auto found = kinds.find(type);
  return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

constexpr std::string_view zlib_compressor = "vtkZLibDataCompressor", lz4_compressor = "vtkLZ4DataCompressor",
                           lzma_compressor = "vtkLZMADataCompressor";

bool can_unpack(std::string_view compressor) {
  return compressor == zlib_compressor || compressor == lz4_compressor || compressor == lzma_compressor;
}
BlockPacking block_packing(std::string_view compressor) {
  return compressor == lz4_compressor ? BlockPacking::lz4 : BlockPacking::xz;
}

template <class T>
double number_of(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double decoded(const char* bytes, VtkArrays::Kind kind) {
  if (kind.family == 'f') return kind.bytes == 4 ? number_of<float>(bytes) : number_of<double>(bytes);
  const bool is_signed = kind.family == 'i';
  switch (kind.bytes) {
    case 1:
      return is_signed ? number_of<int8_t>(bytes) : number_of<uint8_t>(bytes);
    case 2:
      return is_signed ? number_of<int16_t>(bytes) : number_of<uint16_t>(bytes);
    case 4:
      return is_signed ? number_of<int32_t>(bytes) : number_of<uint32_t>(bytes);
    default:
      return is_signed ? number_of<int64_t>(bytes) : number_of<uint64_t>(bytes);
  }
}

// Splits a file: the XML ends where raw bytes begin.
VtkArrays::Parts parts_of_vtk(std::string_view bytes) {
  VtkArrays::Parts parts;
  const size_t tag = bytes.find("<AppendedData");
  if (tag == std::string_view::npos) {
    parts.xml = std::string(bytes);
    return parts;
  }
  const size_t tag_end = std::min(bytes.find('>', tag), bytes.size()), mark = bytes.find('_', tag_end);
  parts.is_base64 = bytes.substr(tag, tag_end - tag).find("base64") != std::string_view::npos;
  if (mark != std::string_view::npos) parts.appended = bytes.substr(mark + 1);
  parts.xml = std::string(bytes.substr(0, tag)) + "</VTKFile>";
  return parts;
}

}  // namespace

VtkArrays::VtkArrays(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
    : parts_(parts_of_vtk(bytes)), file_(name, parts_.xml, diagnostics) {}

void VtkArrays::read_settings(xml_node root) {
  is_swapped_ = file_.attribute(root, "byte_order").value_or("LittleEndian") == "BigEndian";
  has_long_headers_ = file_.attribute(root, "header_type").value_or("UInt32") == "UInt64";
  compressor_ = file_.attribute(root, "compressor").value_or("");
}

VtkArrays::Kind VtkArrays::kind_of(xml_node array) const {
  const auto kind = number_kind(file_.required(array, "type"));
  if (!kind)
    file_.fail_at(array, "numbers of the type " + formats::quoted(file_.required(array, "type")) + " are not read");
  return *kind;
}

std::string VtkArrays::bytes_of(xml_node array, uint64_t count) const {
  const std::string_view format = file_.attribute(array, "format").value_or("ascii");
  const Kind kind = kind_of(array);
  if (count > most_array_bytes / kind.bytes) file_.fail_at(array, "the array is larger than 16 GiB");
  std::string bytes;
  if (format == "binary")
    bytes = array_bytes(array, array.text().get(), true, count * kind.bytes);
  else if (format == "appended")
    bytes = appended_bytes(array, count * kind.bytes);
  else
    file_.fail_at(array, "expected the format ascii, binary or appended, found " + formats::quoted(format));
  if (is_swapped_ && kind.bytes > 1)
    for (size_t at = 0; at < bytes.size(); at += kind.bytes)
      std::reverse(bytes.data() + at, bytes.data() + at + kind.bytes);
  return bytes;
}

std::optional<std::string_view> VtkArrays::bytes_in_file(xml_node array, uint64_t count) const {
  if (file_.attribute(array, "format").value_or("ascii") != "appended") return std::nullopt;
  const Kind kind = kind_of(array);
  if (parts_.is_base64 || !compressor_.empty() || (is_swapped_ && kind.bytes > 1)) return std::nullopt;
  std::string_view text = appended_at(array);
  check_header(array, text, false, count * kind.bytes);
  if (text.size() - header_bytes() < count * kind.bytes) file_.fail_at(array, "the array is cut off");
  return text.substr(header_bytes(), count * kind.bytes);
}

std::vector<double> VtkArrays::numbers(xml_node array, uint64_t count) const {
  const Kind kind = kind_of(array);
  if (file_.attribute(array, "format").value_or("ascii") == "ascii") return numbers_in_text(array, count);
  const std::string bytes = bytes_of(array, count);
  std::vector<double> result(count);
  for (size_t n = 0; n < count; ++n) result[n] = decoded(bytes.data() + n * kind.bytes, kind);
  return result;
}

std::vector<double> VtkArrays::numbers_in_text(xml_node array, uint64_t count) const {
  std::string_view text = array.text().get();
  if (count > text.size()) fail_short(array, count);
  std::vector<double> numbers;
  numbers.reserve(count);
  for (size_t n = 0; n < count; ++n) {
    const std::string_view word = next_word(text);
    if (word.empty()) fail_short(array, count);
    const std::string small = to_lower(word);
    numbers.push_back(small == "nan" || small == "-nan" || small == "inf" || small == "-inf"
                          ? std::nan("")
                          : file_.number(array, word, "a number"));
  }
  return numbers;
}

void VtkArrays::fail_short(xml_node array, uint64_t count) const {
  file_.fail_at(array, "the array is cut off: " + std::to_string(count) + " numbers are expected");
}

std::string_view VtkArrays::appended_at(xml_node array) const {
  const uint64_t offset = file_.count(array, file_.required(array, "offset"), "an offset");
  if (offset >= parts_.appended.size()) file_.fail_at(array, "the array's offset lies beyond the file");
  return parts_.appended.substr(offset);
}

std::string VtkArrays::appended_bytes(xml_node array, uint64_t size) const {
  return array_bytes(array, appended_at(array), parts_.is_base64, size);
}

size_t VtkArrays::header_bytes() const { return has_long_headers_ ? 8 : 4; }
uint64_t VtkArrays::header(std::string_view bytes, size_t n) const {
  std::string word(bytes.substr(n * header_bytes(), header_bytes()));
  if (is_swapped_) std::reverse(word.begin(), word.end());
  return has_long_headers_ ? static_cast<uint64_t>(number_of<uint64_t>(word.data()))
                           : static_cast<uint64_t>(number_of<uint32_t>(word.data()));
}

// Removes the next `size` bytes from the text and returns them; if it is base64, they are encoded separately.
std::string VtkArrays::take(xml_node array, std::string_view& text, bool is_base64, uint64_t size) const {
  if (!is_base64) {
    if (size > text.size()) file_.fail_at(array, "the array is cut off");
    const std::string bytes(text.substr(0, size));
    text.remove_prefix(size);
    return bytes;
  }
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (size > text.size()) file_.fail_at(array, "the array is cut off");
  const uint64_t letters = (size + 2) / 3 * 4;
  auto bytes = from_base64(text.substr(0, letters));
  if (!bytes || bytes->size() < size) file_.fail_at(array, "the array is no base64, or is cut off");
  text.remove_prefix(letters);
  bytes->resize(size);
  return std::move(*bytes);
}

void VtkArrays::check_header(xml_node array, std::string_view text, bool is_base64, uint64_t size) const {
  const std::string head = take(array, text, is_base64, header_bytes());
  if (header(head, 0) != size)
    file_.fail_at(array,
                  "the array has " + std::to_string(header(head, 0)) + " bytes; expected are " + std::to_string(size));
}

// Returns the bytes that follow a header with their size.
std::string VtkArrays::array_bytes(xml_node array, std::string_view text, bool is_base64, uint64_t size) const {
  if (!compressor_.empty()) return unpacked_blocks(array, text, is_base64, size);
  check_header(array, text, is_base64, size);
  std::string bytes = take(array, text, is_base64, header_bytes() + size);
  bytes.erase(0, header_bytes());
  return bytes;
}

// Decompresses blocks of equal size, except the last. The header contains their number, their size, the size of the
// last one, and the compressed size of each.
std::string VtkArrays::unpacked_blocks(xml_node array, std::string_view text, bool is_base64, uint64_t size) const {
  if (!can_unpack(compressor_))
    file_.fail_at(array, "numbers packed by " + formats::quoted(compressor_) + " are not read",
                  "save with zlib (vtkZLibDataCompressor) or without packing");
  std::string_view ahead = text;
  const uint64_t blocks = header(take(array, ahead, is_base64, header_bytes()), 0);
  if (blocks > text.size()) file_.fail_at(array, "the array is cut off");
  const std::string head = take(array, text, is_base64, (3 + blocks) * header_bytes());
  const uint64_t block_size = header(head, 1), last_size = header(head, 2);
  uint64_t packed_size = 0;
  for (size_t n = 0; n < blocks; ++n) {
    packed_size += header(head, 3 + n);
    if (header(head, 3 + n) > text.size() || packed_size > text.size()) file_.fail_at(array, "the array is cut off");
  }
  const std::string packed = take(array, text, is_base64, packed_size);
  std::string result;
  std::string_view left = packed;
  for (size_t n = 0; n < blocks; ++n) {
    const uint64_t wanted = n + 1 == blocks && last_size > 0 ? last_size : block_size;
    if (wanted > size - result.size()) file_.fail_at(array, "the array has more numbers than are expected");
    result += unpacked_block(array, left.substr(0, header(head, 3 + n)), wanted);
    left.remove_prefix(header(head, 3 + n));
  }
  if (result.size() != size) file_.fail_at(array, "the array has fewer numbers than are expected");
  return result;
}

std::string VtkArrays::unpacked_block(xml_node array, std::string_view packed, uint64_t size) const {
  try {
    const std::string bytes = compressor_ == zlib_compressor ? unpacked(file_.name(), packed, Packing::zlib, size)
                                                             : unpack_block(packed, block_packing(compressor_), size);
    if (bytes.size() == size) return bytes;
  } catch (const Error& error) {
    if (error.code() == Code::library_missing) file_.fail_at(array, error.what());
  }
  file_.fail_at(array, "the array's packed numbers are damaged or cut off");
}

}  // namespace ombre::formats

#endif
