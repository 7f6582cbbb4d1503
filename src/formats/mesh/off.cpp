// Reads Geomview OFF as text: [ST][C][N]OFF, counts, vertices, polygons.
#include <algorithm>

#include "base/text/text.h"
#include "formats/containers/counted_warnings.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/mesh_builder.h"

namespace ombre::formats {
namespace {

constexpr char comment = '#';

struct Header {
  bool has_texture = false, has_colours = false, has_normals = false;
  bool has_other_dimension = false;  // headers 4OFF and nOFF
};

bool is_number(std::string_view word) {
  return std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Parses a header; null if the word is not one. The number of vertices may follow without a blank.
std::optional<Header> parse_header(std::string_view word) {
  Header header;
  const auto take = [&word](std::string_view prefix) {
    if (word.substr(0, prefix.size()) != prefix) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  header.has_texture = take("ST");
  header.has_colours = take("C");
  header.has_normals = take("N");
  const bool four = take("4"), any = take("n");
  header.has_other_dimension = four || any;
  if (!take("OFF") || !is_number(word)) return std::nullopt;
  return header;
}

class OffReader {
 public:
  OffReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : scanner_(name, bytes, diagnostics, {comment, false}), name_(name), diagnostics_(diagnostics) {}

  Mesh read() {
    read_header();
    const uint64_t vertices = scanner_.count("the number of vertices");
    const bool is_edges_next = scanner_.at_line_end();  // each count has its own line then
    // The least size is that of "0 0 0" with a line end.
    check_fits(vertices, 6, "vertices");
    const uint64_t faces = scanner_.count("the number of faces");
    // The least size is that of "3 0 1 2" with a line end.
    check_fits(faces, 8, "faces");
    if (is_edges_next) scanner_.count("the number of edges");
    find_lines(vertices + faces, is_edges_next);
    for (uint64_t i = 0; i < vertices; ++i) read_vertex();
    is_one_a_line_ = scanner_.has_lines(faces);
    for (uint64_t i = 0; i < faces; ++i) read_face(i, faces);
    warnings_.report(name_, diagnostics_);
    if (builder_.triangle_count() == 0) fail(diagnostics_, name_, "this OFF file has no faces");
    return builder_.finish().mesh;
  }

 private:
  void read_header() {
    const std::string_view whole = scanner_.word(), word = whole.substr(0, whole.find('\0'));  // NULs do no harm
    if (!word.empty() && is_number(word))
      return scanner_.go_to(scanner_.position() - word.size());  // the header is optional
    const auto header = parse_header(word);
    if (!header) scanner_.fail_at_word("expected OFF, COFF, NOFF or STOFF at the beginning, found " + quoted(word));
    if (header->has_other_dimension) scanner_.fail_at_word("only OFF files in three dimensions can be read");
    header_ = *header;
    if (word.size() < whole.size()) {
      const size_t next = std::min(whole.find_first_not_of('\0', word.size()), whole.size());
      return scanner_.go_to(scanner_.position() - (whole.size() - next));
    }
    scanner_.go_to(scanner_.position() - (word.size() - word.find("OFF") - 3));
    if (scanner_.at_line_end() || scanner_.at_end()) return;
    const size_t before = scanner_.position();
    if (TextScanner(scanner_).word() == "BINARY")
      scanner_.fail_at(before, before + 6, "binary OFF files cannot be read", "save it as text, or as PLY or STL");
  }

  // Skips the number of edges, which is not needed. Most files have a line for each vertex and face, which may contain
  // more than the header promises; in other files, line ends are ignored.
  void find_lines(uint64_t elements, bool are_edges_passed) {
    TextScanner next(scanner_);
    next.next_line();
    is_one_a_line_ = next.has_lines(elements);
    if (!is_one_a_line_ && !are_edges_passed && !scanner_.at_line_end()) scanner_.count("the number of edges");
    if (is_one_a_line_) scanner_.next_line();
  }

  void check_fits(uint64_t count, size_t least_bytes, std::string_view what) {
    if (count <= (scanner_.remaining() + 1) / least_bytes) return;
    scanner_.fail_at_word("the header promises " + format_count(count) + " " + std::string(what) +
                          ", more than the file has room for");
  }

  // Reads a vertex; normals and colours are skipped, texture coordinates come last.
  void read_vertex() {
    builder_.add_vertex(scanner_.point("a coordinate of a vertex"));
    if (!is_one_a_line_) return read_rest_of_vertex();
    if (header_.has_colours && !header_.has_normals) read_colour();
    if (header_.has_texture) read_texture_coordinate();
    scanner_.next_line();
  }

  // Reads red, green, blue and, where it is there, alpha.
  void read_colour() {
    std::array<double, 4> colour{0, 0, 0, 1};
    bool has_bytes = false;
    for (size_t n = 0; n < colour.size(); ++n) {
      if (scanner_.at_line_end()) {
        if (n < 3) return;
        colour[n] = has_bytes ? 255 : 1;
        continue;
      }
      colour[n] = scanner_.number("a part of a colour");
      has_bytes = has_bytes || colour[n] > 1;
    }
    builder_.add_colour(colour);
  }

  void read_rest_of_vertex() {
    for (int i = 0; i < (header_.has_normals ? 3 : 0); ++i) scanner_.number("a part of a normal");
    std::array<double, 4> colour{};
    for (size_t n = 0; n < (header_.has_colours ? colour.size() : 0); ++n)
      colour[n] = scanner_.number("a part of a colour");
    if (header_.has_colours) builder_.add_colour(colour);
    if (!header_.has_texture) return;
    const double u = scanner_.coordinate("a texture coordinate");
    builder_.add_texture_coordinate(u, scanner_.coordinate("a texture coordinate"));
  }

  void read_texture_coordinate() {
    double u = 0, v = 0;
    size_t found = 0;
    for (; !scanner_.at_line_end(); ++found) {
      u = v;
      v = scanner_.coordinate("a texture coordinate");
    }
    if (found < 2) scanner_.fail_here("expected the texture coordinates of a vertex, but the line ends here");
    builder_.add_texture_coordinate(u, v);
  }

  void read_face(uint64_t number, uint64_t faces) {
    if (scanner_.at_end())
      scanner_.fail_here("this OFF is cut short: " + format_count(faces) + " faces are promised, the file ends after " +
                         format_count(number));
    const uint64_t count = scanner_.count("the number of corners of a face");
    if (count > scanner_.remaining() / 2)
      scanner_.fail_at_word("a face of " + format_count(count) + " corners is more than the file has room for");
    corners_.clear();
    for (uint64_t i = 0; i < count; ++i) {
      const uint64_t corner = scanner_.count("the number of a vertex");
      if (corner >= builder_.vertex_count())
        scanner_.fail_at_word("the face uses vertex " + std::to_string(corner) + ", but the " +
                              format_count(builder_.vertex_count()) + " vertices are numbered from 0");
      corners_.push_back(static_cast<uint32_t>(corner));
    }
    if (count < 3)
      warnings_.add("a face of fewer than three corners is no part of the surface",
                    "faces of fewer than three corners are no part of the surface");
    else
      builder_.add_polygon(corners_,
                           header_.has_texture ? std::span<const uint32_t>(corners_) : std::span<const uint32_t>());
    // A colour may follow the corners.
    if (is_one_a_line_) scanner_.next_line();
  }

  TextScanner scanner_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  MeshBuilder builder_;
  std::vector<uint32_t> corners_;
  CountedWarnings warnings_;
  Header header_;
  bool is_one_a_line_ = true;
};

}  // namespace

bool is_off(std::string_view bytes) {
  Diagnostics unused;
  TextScanner scanner("", bytes, unused, {comment, false});
  return parse_header(scanner.word()).has_value();
}

std::optional<Mesh> read_off(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return read_or_null(name, bytes, diagnostics, [&] { return OffReader(name, bytes, diagnostics).read(); });
}

}  // namespace ombre::formats
