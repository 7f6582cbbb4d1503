// STL: binary (an 80-byte header, a count, 50 bytes for each triangle) and text.
#include <bit>
#include <cmath>
#include <cstring>

#include "base/text.h"
#include "formats/mesh.h"
#include "formats/mesh_builder.h"
#include "formats/text_scanner.h"
#include "formats/vertex_merger.h"

namespace ombre::formats {
namespace {

constexpr size_t bytes_before_triangles = 84, count_offset = 80;
constexpr size_t triangle_bytes = 50, normal_bytes = 12;
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
         bytes.size() == bytes_before_triangles + triangle_bytes * promised_triangles(bytes);
}

// Binary files may begin with "solid" as well, but text has no zero bytes.
bool looks_like_text(std::string_view bytes) {
  const size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || to_lower(bytes.substr(first, 5)) != "solid") return false;
  return bytes.substr(0, sniffed_bytes).find('\0') == std::string_view::npos;
}

// Checks that the triangles which the header promises are there.
void check_size(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  if (bytes.size() < bytes_before_triangles)
    fail(diagnostics, name,
         "this is not an STL file: it has " + format_count(bytes.size()) +
             " bytes, does not begin with \"solid\", and a binary STL has at least 84");
  const uint64_t triangles = promised_triangles(bytes);
  const uint64_t needed = bytes_before_triangles + triangle_bytes * triangles;
  if (bytes.size() < needed)
    fail(diagnostics, name,
         "this binary STL is cut short: its header promises " + format_count(triangles) + " triangles (" +
             format_count(needed) + " bytes), the file has " + format_count(bytes.size()) + " bytes");
  if (triangles == 0) fail(diagnostics, name, "this binary STL has no triangles");
  if (bytes.size() > needed)
    diagnostics.warning({}, name + ": " + format_count(bytes.size() - needed) + " bytes after the last of " +
                                format_count(triangles) + " triangles are not read");
}

Mesh read_binary(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  check_size(name, bytes, diagnostics);
  const uint64_t count = promised_triangles(bytes);
  VertexMerger merger;
  Mesh mesh;
  mesh.triangles.resize(count);
  for (uint64_t t = 0; t < count; ++t) {
    const size_t at = bytes_before_triangles + triangle_bytes * t + normal_bytes;
    for (size_t corner = 0; corner < 3; ++corner) {
      const char* const from = bytes.data() + at + 12 * corner;
      const Vec3 p{load_float(from), load_float(from + 4), load_float(from + 8)};
      if (!(std::abs(p.x) <= greatest_coordinate && std::abs(p.y) <= greatest_coordinate &&
            std::abs(p.z) <= greatest_coordinate))
        fail(diagnostics, name,
             "corner " + std::to_string(corner + 1) + " of triangle " + format_count(t + 1) + " (at byte " +
                 format_count(at + 12 * corner) + ") is not a usable point: (" + format_number(p.x) + ", " +
                 format_number(p.y) + ", " + format_number(p.z) + ")");
      mesh.triangles[t][corner] = merger.add(p);
    }
  }
  mesh.vertices = merger.take_places();
  mesh.groups.push_back({"", 0, static_cast<uint32_t>(count)});
  return mesh;
}

// solid NAME, then facets, then endsolid NAME; any number of solids.
class TextReader {
 public:
  TextReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : scanner_(name, bytes, diagnostics) {}

  Mesh read() {
    while (!scanner_.at_end()) {
      expect("solid", "a solid begins");
      builder_.start_group(std::string(scanner_.rest_of_line()));
      while (read_facet()) continue;
    }
    if (builder_.triangle_count() == 0) scanner_.fail_here("this STL has no facets");
    return builder_.finish(merger_.take_places()).mesh;
  }

 private:
  void expect(std::string_view keyword, std::string_view where) {
    const std::string_view found = scanner_.word();
    if (to_lower(found) == keyword) return;
    if (found.empty())
      scanner_.fail_here("this STL is cut short: expected \"" + std::string(keyword) + "\" where " +
                         std::string(where) + ", but the file ends here");
    scanner_.fail_at_word("expected \"" + std::string(keyword) + "\" where " + std::string(where) + ", found " +
                          quoted(found));
  }

  // False when the solid ends.
  bool read_facet() {
    const std::string keyword = to_lower(scanner_.word());
    if (keyword == "endsolid") {
      scanner_.rest_of_line();
      return false;
    }
    if (keyword.empty())
      scanner_.fail_here("this STL is cut short: expected \"facet\" or \"endsolid\", but the file ends here");
    if (keyword != "facet") scanner_.fail_at_word("expected \"facet\" or \"endsolid\", found " + quoted(keyword));
    // Normals follow from the corners, and many files hold none worth reading.
    expect("normal", "a facet begins");
    for (int i = 0; i < 3; ++i) scanner_.word();
    expect("outer", "a facet's corners begin");
    expect("loop", "a facet's corners begin");
    std::array<uint32_t, 3> corners;
    for (uint32_t& corner : corners) {
      expect("vertex", "one of three corners is due");
      corner = merger_.add(scanner_.point("a coordinate of a corner"));
    }
    expect("endloop", "a facet has its three corners");
    expect("endfacet", "a facet ends");
    builder_.add_polygon(corners);
    return true;
  }

  TextScanner scanner_;
  MeshBuilder builder_;
  VertexMerger merger_;
};

}  // namespace

bool is_stl(std::string_view bytes) { return has_binary_size(bytes) || looks_like_text(bytes); }

std::optional<Mesh> read_stl(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  try {
    if (bytes.empty()) fail(diagnostics, name, "the file is empty");
    if (has_binary_size(bytes) || !looks_like_text(bytes)) return read_binary(name, bytes, diagnostics);
    return TextReader(name, bytes, diagnostics).read();
  } catch (const DesignError&) {
    return std::nullopt;
  }
}

}  // namespace ombre::formats
