// Reads binary STL (an 80-byte header, a count, 50 bytes for each triangle), and distinguishes it from text.
#include <bit>
#include <cmath>
#include <cstring>

#include "base/text/text.h"
#include "formats/containers/file_kinds.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/stl_text.h"
#include "formats/mesh/vertex_merger.h"

namespace ombre::formats {
namespace {

constexpr size_t bytes_before_triangles = 84, count_offset = 80;
constexpr size_t bytes_of_triangle = 50, normal_bytes = 12, corner_bytes = 12;
constexpr size_t sniffed_bytes = 1024;

uint32_t load_u32(const char* bytes) {
  unsigned char b[4];
  std::memcpy(b, bytes, 4);
  return b[0] | uint32_t{b[1]} << 8 | uint32_t{b[2]} << 16 | uint32_t{b[3]} << 24;
}

double load_float(const char* bytes) { return std::bit_cast<float>(load_u32(bytes)); }

uint64_t promised_triangles(std::string_view bytes) { return load_u32(bytes.data() + count_offset); }

bool has_binary_size(std::string_view bytes) {
  return bytes.size() >= bytes_before_triangles &&
         bytes.size() == bytes_before_triangles + bytes_of_triangle * promised_triangles(bytes);
}

// Returns true for text. Binary files may begin with "solid" too, but text has no zero bytes, except where a program
// fills up the name of the solid with them; then a corner follows. Some writers omit the first line.
bool is_like_text(std::string_view bytes) {
  const size_t first = bytes.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  if (first == std::string_view::npos) return false;
  const std::string word = to_lower(bytes.substr(first, 5));
  if (word != "solid" && word != "facet") return false;
  const std::string_view begin = bytes.substr(0, sniffed_bytes);
  return !has_zeros(begin) || to_lower(begin).find("vertex") != std::string::npos;
}

[[noreturn]] void fail_not_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  const std::string_view word = TextScanner(name, bytes, diagnostics).word();
  if (word.empty()) fail(diagnostics, name, "this is not an STL file: it holds nothing but blanks");
  if (is_plain_text(bytes.substr(0, sniffed_bytes)))
    fail(diagnostics, name,
         "this is not an STL file: it is text that begins with " + quoted(word) + " in place of \"solid\"");
  fail(diagnostics, name,
       "this is not an STL file: it has " + format_count(bytes.size()) +
           " bytes, does not begin with \"solid\", and a binary STL has at least 84");
}

bool is_usable(Vec3 p) {
  return std::abs(p.x) <= greatest_coordinate && std::abs(p.y) <= greatest_coordinate &&
         std::abs(p.z) <= greatest_coordinate;
}

Vec3 load_corner(std::string_view bytes, uint64_t triangle, size_t corner) {
  const char* const from =
      bytes.data() + bytes_before_triangles + bytes_of_triangle * triangle + normal_bytes + corner_bytes * corner;
  return {load_float(from), load_float(from + 4), load_float(from + 8)};
}

// Returns true if the bytes can be triangles: neither zeros used as padding nor other data.
bool hold_triangles(std::string_view bytes, uint64_t begin, uint64_t end) {
  for (uint64_t t = begin; t < end; ++t) {
    const Vec3 a = load_corner(bytes, t, 0), b = load_corner(bytes, t, 1), c = load_corner(bytes, t, 2);
    if (!is_usable(a) || !is_usable(b) || !is_usable(c) || (a == Vec3{} && b == Vec3{} && c == Vec3{})) return false;
  }
  return true;
}

// Returns the number of triangles. If the header's count is wrong, it follows from the size of the file.
uint64_t count_triangles(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  if (bytes.size() < bytes_before_triangles || is_plain_text(bytes.substr(0, sniffed_bytes)))
    fail_not_stl(name, bytes, diagnostics);
  const uint64_t promised = promised_triangles(bytes);
  const uint64_t needed = bytes_before_triangles + bytes_of_triangle * promised;
  if (bytes.size() == needed && promised > 0) return promised;
  const uint64_t present = (bytes.size() - bytes_before_triangles) / bytes_of_triangle;
  if (present > 0 && present <= UINT32_MAX && (bytes.size() - bytes_before_triangles) % bytes_of_triangle == 0 &&
      (present < promised || hold_triangles(bytes, promised, present))) {
    diagnostics.warning({}, name + ": the header promises " + format_count(promised) + " triangles, but the file has " +
                                format_count(present) + ", which are read");
    return present;
  }
  if (bytes.size() < needed)
    fail(diagnostics, name,
         "this binary STL is cut short: its header promises " + format_count(promised) + " triangles (" +
             format_count(needed) + " bytes), the file has " + format_count(bytes.size()) + " bytes");
  if (promised == 0) fail(diagnostics, name, "this binary STL has no triangles");
  diagnostics.warning({}, name + ": " + format_count(bytes.size() - needed) + " bytes after the last of " +
                              format_count(promised) + " triangles are not read");
  return promised;
}

Mesh read_binary(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  const uint64_t count = count_triangles(name, bytes, diagnostics);
  VertexMerger merger;
  Mesh mesh;
  mesh.triangles.resize(count);
  for (uint64_t t = 0; t < count; ++t) {
    const uint64_t at = bytes_before_triangles + bytes_of_triangle * t + normal_bytes;
    for (size_t corner = 0; corner < 3; ++corner) {
      const Vec3 p = load_corner(bytes, t, corner);
      if (!is_usable(p))
        fail(diagnostics, name,
             "corner " + std::to_string(corner + 1) + " of triangle " + format_count(t + 1) + " (at byte " +
                 format_count(at + corner_bytes * corner) + ") is not a usable point: (" + format_number(p.x) + ", " +
                 format_number(p.y) + ", " + format_number(p.z) + ")");
      mesh.triangles[t][corner] = merger.add(p);
    }
  }
  mesh.vertices = merger.take_places();
  mesh.groups.push_back({"", 0, static_cast<uint32_t>(count)});
  return mesh;
}

}  // namespace

bool is_stl(std::string_view bytes) { return has_binary_size(bytes) || is_like_text(bytes); }

std::optional<Mesh> read_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  const auto read = has_binary_size(bytes) || !is_like_text(bytes) ? read_binary : read_stl_text;
  return read_or_null(name, bytes, diagnostics, [&] { return read(name, bytes, diagnostics); });
}

}  // namespace ombre::formats
