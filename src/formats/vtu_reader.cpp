// Unstructured grids of VTK's XML files (.vtu).
#ifdef OMBRE_3MF

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include "base/error.h"
#include "base/text.h"
#include "formats/base64.h"
#include "formats/mesh.h"
#include "formats/results_readers.h"
#include "formats/text_scanner.h"
#include "formats/volume_packing.h"
#include "formats/xml_file.h"

namespace ombre::formats {
namespace {

using pugi::xml_node;

static_assert(std::endian::native == std::endian::little, "numbers are turned round for others alone");

constexpr uint64_t most_vtu_bytes = uint64_t{16} << 30;  // of one array, unpacked

constexpr size_t most_fields = 1000;

struct NumberKind {
  size_t bytes = 0;
  char family = ' ';  // f, i or u
};

std::optional<NumberKind> number_kind(std::string_view type) {
  static const std::map<std::string_view, NumberKind> kinds{
      {"Float32", {4, 'f'}}, {"Float64", {8, 'f'}}, {"Int8", {1, 'i'}},   {"Int16", {2, 'i'}},  {"Int32", {4, 'i'}},
      {"Int64", {8, 'i'}},   {"UInt8", {1, 'u'}},   {"UInt16", {2, 'u'}}, {"UInt32", {4, 'u'}}, {"UInt64", {8, 'u'}}};
  const auto found = kinds.find(type);
  return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

template <class T>
double number_of(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

double decoded(const char* bytes, NumberKind kind) {
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

// The XML ends where raw bytes begin.
struct VtuParts {
  std::string xml;
  std::string_view appended;  // behind its underscore
  bool is_base64 = false;
};

VtuParts parts_of_vtu(std::string_view bytes) {
  VtuParts parts{std::string(bytes), {}, false};
  const size_t tag = bytes.find("<AppendedData");
  if (tag == std::string_view::npos) return parts;
  const size_t tag_end = std::min(bytes.find('>', tag), bytes.size()), mark = bytes.find('_', tag_end);
  parts.is_base64 = bytes.substr(tag, tag_end - tag).find("base64") != std::string_view::npos;
  if (mark != std::string_view::npos) parts.appended = bytes.substr(mark + 1);
  parts.xml = std::string(bytes.substr(0, tag)) + "</VTKFile>";
  return parts;
}

// Elements that are read, by VTK's numbers.
struct CellKind {
  ElementKind kind;
  bool has_crossed_rows;  // nodes by x, then y, then z
};
std::optional<CellKind> cell_kind(double type) {
  static const std::map<double, CellKind> kinds{{10, {ElementKind::tetrahedron4, false}},
                                                {11, {ElementKind::brick8, true}},
                                                {12, {ElementKind::brick8, false}},
                                                {24, {ElementKind::tetrahedron10, false}},
                                                {25, {ElementKind::brick20, false}}};
  const auto found = kinds.find(type);
  return found == kinds.end() ? std::nullopt : std::optional(found->second);
}
// Points, lines and faces, which enclose no space.
bool is_flat_cell(double type) { return (type >= 0 && type <= 9) || (type >= 21 && type <= 23) || type == 28; }

class VtuReader {
 public:
  VtuReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : parts_(parts_of_vtu(bytes)), file_(name, parts_.xml, diagnostics), bytes_(bytes) {}

  Results run() {
    const xml_node root = file_.root("VTKFile");
    if (file_.required(root, "type") != "UnstructuredGrid")
      file_.fail_at(root, "this file holds no unstructured grid but " + quoted(file_.required(root, "type")),
                    "save the results as .vtu");
    is_swapped_ = file_.attribute(root, "byte_order").value_or("LittleEndian") == "BigEndian";
    has_long_headers_ = file_.attribute(root, "header_type").value_or("UInt32") == "UInt64";
    const std::string_view compressor = file_.attribute(root, "compressor").value_or("");
    is_packed_ = !compressor.empty();
    if (is_packed_ && compressor != "vtkZLibDataCompressor")
      file_.fail_at(root, "numbers packed by " + quoted(compressor) + " are not read",
                    "save with zlib or without packing");
    for (const xml_node piece : root.child("UnstructuredGrid").children("Piece")) add_piece(piece);
    tell_of_flat_cells();
    return std::move(results_);
  }

 private:
  void add_piece(xml_node piece) {
    const size_t points = results_.points.size(), before = results_.kinds.size();
    const uint64_t point_count = file_.count(piece, file_.required(piece, "NumberOfPoints"), "a count of points"),
                   cell_count = file_.count(piece, file_.required(piece, "NumberOfCells"), "a count of cells");
    if (point_count > bytes_.size() * 1032 || cell_count > bytes_.size() * 1032 || points + point_count > UINT32_MAX)
      file_.fail_at(piece, "the piece states more points or cells than the file can hold");
    if (point_count == 0) return;
    add_points(piece, point_count);
    const std::vector<bool> is_kept = add_cells(piece, points, point_count, cell_count);
    add_fields(piece.child("PointData"), false, points, std::vector<bool>(point_count, true));
    add_fields(piece.child("CellData"), true, before, is_kept);
  }

  void add_points(xml_node piece, uint64_t count) {
    const xml_node array = piece.child("Points").child("DataArray");
    if (!array) file_.fail_at(piece, "the piece has no points");
    const std::vector<double> numbers = numbers_of(array, 3 * count);
    for (size_t n = 0; n < count; ++n) {
      const Vec3 p{numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2]};
      for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(p[axis]) <= greatest_coordinate))
          file_.fail_at(array, "point " + std::to_string(n) + " has a coordinate that is not finite or beyond 1e15");
      results_.points.push_back(p);
    }
  }

  xml_node array_called(xml_node parent, std::string_view name) const {
    for (const xml_node array : parent.children("DataArray"))
      if (array.attribute("Name").value() == name) return array;
    file_.fail_at(parent, "expected an array " + quoted(name) + " among the cells");
  }

  // Returns which cells became elements.
  std::vector<bool> add_cells(xml_node piece, size_t first_point, uint64_t point_count, uint64_t count) {
    std::vector<bool> is_kept(count, false);
    const xml_node cells = piece.child("Cells");
    if (count == 0) return is_kept;
    const std::vector<double> types = numbers_of(array_called(cells, "types"), count),
                              ends = numbers_of(array_called(cells, "offsets"), count);
    const xml_node list = array_called(cells, "connectivity");
    if (!(ends.back() >= 0 && ends.back() <= static_cast<double>(bytes_.size()) * 1032))
      file_.fail_at(list, "the offsets of cells go beyond the file");
    const std::vector<double> corners = numbers_of(list, static_cast<uint64_t>(ends.back()));
    std::array<uint32_t, 20> nodes{};
    for (size_t n = 0; n < count; ++n) {
      const double begin = n == 0 ? 0 : ends[n - 1];
      const auto kind = cell_kind(types[n]);
      if (!kind && is_flat_cell(types[n])) {
        ++flat_cells_;
        continue;
      }
      if (!kind)
        file_.fail_at(list, "cell " + std::to_string(n) + " is of VTK's type " + format_number(types[n]) +
                                "; read are tetrahedra (10, 24), hexahedra (12, 25) and voxels (11)");
      const size_t size = node_count(kind->kind);
      if (!(begin >= 0) || begin + static_cast<double>(size) != ends[n] || ends[n] > ends.back())
        file_.fail_at(list,
                      "cell " + std::to_string(n) + " has not the " + std::to_string(size) + " nodes of its type");
      for (size_t c = 0; c < size; ++c) {
        const double node = corners[static_cast<size_t>(begin) + c];
        if (!(node >= 0 && node < static_cast<double>(point_count)))
          file_.fail_at(list, "cell " + std::to_string(n) + " names point " + format_number(node) + "; there are " +
                                  std::to_string(point_count));
        nodes[c] = static_cast<uint32_t>(first_point + static_cast<size_t>(node));
      }
      if (kind->has_crossed_rows) {
        std::swap(nodes[2], nodes[3]);
        std::swap(nodes[6], nodes[7]);
      }
      results_.add_element(kind->kind, nodes.data());
      is_kept[n] = true;
    }
    return is_kept;
  }

  // `before` numbers of other pieces stand before these.
  void add_fields(xml_node parent, bool is_of_elements, size_t before, const std::vector<bool>& is_kept) {
    for (const xml_node array : parent.children("DataArray")) {
      if (file_.attribute(array, "type") == "String") continue;
      ResultField field;
      set_name(field, file_.attribute(array, "Name").value_or("values"));
      field.is_of_elements = is_of_elements;
      field.components =
          file_.count(array, file_.attribute(array, "NumberOfComponents").value_or("1"), "a number of components");
      if (field.components < 1 || field.components > 9)
        file_.fail_at(array, "the field " + quoted(field.name) + " has " + std::to_string(field.components) +
                                 " components; 1 to 9 are read");
      const std::vector<double> numbers = numbers_of(array, field.components * is_kept.size());
      ResultField& all = field_of(field, before);
      for (size_t n = 0; n < is_kept.size(); ++n)
        if (is_kept[n])
          all.values.insert(all.values.end(), numbers.begin() + static_cast<ptrdiff_t>(n * field.components),
                            numbers.begin() + static_cast<ptrdiff_t>((n + 1) * field.components));
    }
    fill_up(is_of_elements);
  }

  // The field of that name of earlier pieces, or a new one that has no numbers there.
  ResultField& field_of(const ResultField& wanted, size_t before) {
    for (ResultField& field : results_.fields)
      if (field.name == wanted.name && field.is_of_elements == wanted.is_of_elements &&
          field.components == wanted.components && field.values.size() == before * wanted.components)
        return field;
    if (results_.fields.size() >= most_fields) fail_fields();
    results_.fields.push_back(wanted);
    results_.fields.back().values.assign(before * wanted.components, std::nan(""));
    return results_.fields.back();
  }

  [[noreturn]] void fail_fields() const {
    fail(file_.diagnostics(), file_.name(), "the file has more than " + std::to_string(most_fields) + " fields");
  }

  void fill_up(bool is_of_elements) {
    const size_t count = is_of_elements ? results_.kinds.size() : results_.points.size();
    for (ResultField& field : results_.fields)
      if (field.is_of_elements == is_of_elements) field.values.resize(count * field.components, std::nan(""));
  }

  std::vector<double> numbers_of(xml_node array, uint64_t count) const {
    const std::string_view format = file_.attribute(array, "format").value_or("ascii");
    const auto kind = number_kind(file_.required(array, "type"));
    if (!kind) file_.fail_at(array, "numbers of the type " + quoted(file_.required(array, "type")) + " are not read");
    if (format == "ascii") return numbers_in_text(array, count);
    if (count > most_vtu_bytes / kind->bytes) file_.fail_at(array, "the array is larger than 16 GiB");
    std::string bytes;
    if (format == "binary")
      bytes = array_bytes(array, array.text().get(), true, count * kind->bytes);
    else if (format == "appended")
      bytes = appended_bytes(array, count * kind->bytes);
    else
      file_.fail_at(array, "expected the format ascii, binary or appended, found " + quoted(format));
    std::vector<double> numbers(count);
    for (size_t n = 0; n < count; ++n) {
      char* const at = bytes.data() + n * kind->bytes;
      if (is_swapped_) std::reverse(at, at + kind->bytes);
      numbers[n] = decoded(at, *kind);
    }
    return numbers;
  }

  std::vector<double> numbers_in_text(xml_node array, uint64_t count) const {
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

  [[noreturn]] void fail_short(xml_node array, uint64_t count) const {
    file_.fail_at(array, "the array is cut off: " + std::to_string(count) + " numbers are expected");
  }

  std::string appended_bytes(xml_node array, uint64_t size) const {
    const uint64_t offset = file_.count(array, file_.required(array, "offset"), "an offset");
    if (offset >= parts_.appended.size()) file_.fail_at(array, "the array's offset lies beyond the file");
    return array_bytes(array, parts_.appended.substr(offset), parts_.is_base64, size);
  }

  size_t header_bytes() const { return has_long_headers_ ? 8 : 4; }
  uint64_t header(std::string_view bytes, size_t n) const {
    std::string word(bytes.substr(n * header_bytes(), header_bytes()));
    if (is_swapped_) std::reverse(word.begin(), word.end());
    return has_long_headers_ ? static_cast<uint64_t>(number_of<uint64_t>(word.data()))
                             : static_cast<uint64_t>(number_of<uint32_t>(word.data()));
  }

  // The next so many bytes of `text`, which is base64 by itself up to there.
  std::string take(xml_node array, std::string_view& text, bool is_base64, uint64_t size) const {
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

  // Behind a header that states how much there is.
  std::string array_bytes(xml_node array, std::string_view text, bool is_base64, uint64_t size) const {
    if (is_packed_) return unpacked_blocks(array, text, is_base64, size);
    std::string_view ahead = text;
    const std::string head = take(array, ahead, is_base64, header_bytes());
    if (header(head, 0) != size)
      file_.fail_at(
          array, "the array has " + std::to_string(header(head, 0)) + " bytes; expected are " + std::to_string(size));
    std::string bytes = take(array, text, is_base64, header_bytes() + size);
    bytes.erase(0, header_bytes());
    return bytes;
  }

  // Packed blocks of equal size, but for the last; the header has their number, their size, the last one's, and what
  // each takes packed.
  std::string unpacked_blocks(xml_node array, std::string_view text, bool is_base64, uint64_t size) const {
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

  std::string unpacked_block(xml_node array, std::string_view packed, uint64_t size) const {
    try {
      return unpacked(file_.name(), packed, Packing::zlib, size);
    } catch (const Error&) {
      file_.fail_at(array, "the array's packed numbers are damaged or cut off");
    }
  }

  void tell_of_flat_cells() const {
    if (flat_cells_ == 0) return;
    file_.diagnostics().warning({make_source(file_.name(), ""), 0, 0},
                                format_count(flat_cells_) + " points, lines or faces of the grid are left out");
  }

  VtuParts parts_;
  XmlFile file_;
  std::string_view bytes_;
  Results results_;
  bool is_swapped_ = false, has_long_headers_ = false, is_packed_ = false;
  uint64_t flat_cells_ = 0;
};

}  // namespace

Results read_vtu(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return VtuReader(name, bytes, diagnostics).run();
}

}  // namespace ombre::formats

#endif
