// Reads Wavefront OBJ: vertices, texture coordinates, faces, and the names of objects, groups and materials.
#include <algorithm>
#include <charconv>
#include <span>

#include "base/text/text.h"
#include "formats/containers/counted_warnings.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh.h"
#include "formats/mesh/mesh_builder.h"

namespace ombre::formats {
namespace {

// Statements that do not affect the surface, and those that belong to a free-form surface.
constexpr std::string_view passed_over[]{
    "vn",     "s",        "mtllib", "l",    "p",    "vp",     "cstype",     "deg",       "bmat",  "step",     "curv",
    "curv2",  "parm",     "trim",   "hole", "sp",   "end",    "con",        "mg",        "bevel", "c_interp", "lod",
    "maplib", "d_interp", "res",    "cdc",  "scrv", "usemap", "shadow_obj", "trace_obj", "ctech", "stech"};
// Statements that add to the surface but are not supported: free-form surfaces, and the contents of other files.
constexpr std::string_view left_out[]{"surf", "bsp", "bzp", "cdp", "call", "csh"};

bool is_one_of(std::string_view word, std::span<const std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

class ObjReader {
 public:
  ObjReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : scanner_(name, bytes, diagnostics, {'#', true}), name_(name), diagnostics_(diagnostics) {}

  Mesh read() {
    while (!scanner_.at_end()) {
      read_statement(scanner_.word_in_line());
      scanner_.next_line();
    }
    if (builder_.triangle_count() == 0 && unknown_end_ > 0) fail_at_unknown();
    warnings_.report(name_, diagnostics_);
    if (builder_.triangle_count() == 0)
      fail(diagnostics_, name_, "this OBJ file has no faces (lines that begin with f)");
    MeshBuilder::Result result = builder_.finish();
    if (result.untextured > 0)
      diagnostics_.warning(
          {}, name_ + ": " + format_count(result.untextured) + " triangles have no texture coordinates and get (0, 0)");
    return std::move(result.mesh);
  }

 private:
  void read_statement(std::string_view keyword) {
    if (keyword == "v") return read_vertex();
    if (keyword == "vt") return read_texture_coordinate();
    if (keyword == "f" || keyword == "fo") return read_face();
    if (keyword == "o" || keyword == "g") {
      object_ = scanner_.rest_of_line();
      return start_group();
    }
    if (keyword == "usemtl") {
      material_ = scanner_.rest_of_line();
      return start_group();
    }
    if (is_one_of(keyword, passed_over)) return;
    if (!is_one_of(keyword, left_out) && unknown_end_ == 0) {
      unknown_end_ = scanner_.position();
      unknown_begin_ = unknown_end_ - keyword.size();
    }
    const std::string statement = ' ' + quoted(keyword);
    warnings_.add("a statement" + statement + " is not read", "statements" + statement + " are not read");
  }

  // Reports the first unknown statement of a file without faces, which is not an OBJ file.
  [[noreturn]] void fail_at_unknown() const {
    TextScanner word(scanner_);
    word.go_to(unknown_begin_);
    scanner_.fail_at(unknown_begin_, unknown_end_, "an OBJ file has no statement " + quoted(word.word_in_line()),
                     "v, vt, f, o, g and usemtl make up a mesh; # begins a comment");
  }

  void start_group() { builder_.start_group(object_.empty() ? material_ : object_, material_); }

  // Reads a vertex. Three numbers that follow are its colour, as several programs write it; others are skipped by
  // next_line(), such as a weight.
  void read_vertex() {
    need_in_line("a coordinate of a vertex");
    Vec3 p;
    p.x = scanner_.coordinate("a coordinate of a vertex");
    need_in_line("a coordinate of a vertex");
    p.y = scanner_.coordinate("a coordinate of a vertex");
    need_in_line("a coordinate of a vertex");
    p.z = scanner_.coordinate("a coordinate of a vertex");
    if (builder_.vertex_count() >= MeshBuilder::most_vertices) scanner_.fail_here("there are too many vertices");
    builder_.add_vertex(p);
    std::array<double, 4> colour{0, 0, 0, 1};
    for (size_t n = 0; n < 3; ++n) {
      const auto part = scanner_.at_line_end() ? std::nullopt : texture_number();
      if (!part) return;
      colour[n] = *part;
    }
    builder_.add_colour(colour);
  }

  // Reads a texture coordinate. One that is no number counts as (0, 0), since the surface does not depend on it.
  void read_texture_coordinate() {
    const auto u = texture_number(), v = texture_number();
    if (builder_.texture_coordinate_count() >= MeshBuilder::most_vertices)
      scanner_.fail_here("there are too many texture coordinates");
    if (u && v) return builder_.add_texture_coordinate(*u, *v);
    warnings_.add("a texture coordinate is no number and becomes (0, 0)",
                  "texture coordinates are no numbers and become (0, 0)");
    builder_.add_texture_coordinate(0, 0);
  }

  // Returns the next number in the line, or 0 at its end; null if it is not usable.
  std::optional<double> texture_number() {
    const std::string_view word = scanner_.word_in_line();
    if (word.empty()) return 0.0;
    Diagnostics ignored;
    return read_or_null(name_, word, ignored, [&] { return TextScanner(name_, word, ignored).coordinate(""); });
  }

  void need_in_line(std::string_view what) {
    if (scanner_.at_line_end()) scanner_.fail_here("expected " + std::string(what) + ", but the line ends here");
  }

  void read_face() {
    corners_.clear();
    texture_.clear();
    while (!scanner_.at_line_end()) read_corner(scanner_.word_in_line());
    if (corners_.size() < 3)
      return warnings_.add("a face of fewer than three corners is no part of the surface",
                           "faces of fewer than three corners are no part of the surface");
    // Texture coordinates of a face are ignored if only some of its corners have them.
    if (texture_.size() != corners_.size()) texture_.clear();
    builder_.add_polygon(corners_, texture_);
  }

  // Reads V, V/VT, V//VN or V/VT/VN. Some programs write V/VN, or texture coordinates that do not exist; the surface
  // needs neither.
  void read_corner(std::string_view text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    const int64_t vertex = read_index(at, end, text);
    const auto corner = resolve(vertex, builder_.vertex_count());
    if (!corner)
      scanner_.fail_at_word("the corner " + quoted(text) + " uses vertex " + std::to_string(vertex) + ", but " +
                            format_count(builder_.vertex_count()) + " vertices come before it");
    corners_.push_back(*corner);
    if (at == end) return;
    if (*at++ != '/') fail_corner(text);
    if (at != end && *at != '/') read_texture_index(read_index(at, end, text));
    if (at == end) return;
    if (*at++ != '/') fail_corner(text);
    if (at != end) read_index(at, end, text);
    if (at != end) fail_corner(text);
  }

  int64_t read_index(const char*& at, const char* end, std::string_view corner) {
    int64_t index = 0;
    const auto [stop, status] = std::from_chars(at, end, index);
    if (status != std::errc() || index == 0) fail_corner(corner);
    at = stop;
    return index;
  }

  void read_texture_index(int64_t index) {
    if (const auto texture = resolve(index, builder_.texture_coordinate_count()))
      texture_.push_back(*texture);
    else if (builder_.texture_coordinate_count() > 0)
      warnings_.add("a corner uses a texture coordinate that the file does not have",
                    "corners use texture coordinates that the file does not have");
  }

  // Resolves an index, which counts from 1, or backwards from the last if negative. Null if it is out of range.
  static std::optional<uint32_t> resolve(int64_t index, size_t count) {
    const auto known = static_cast<int64_t>(count);
    if (index > known || index < -known) return std::nullopt;
    return static_cast<uint32_t>(index > 0 ? index - 1 : known + index);
  }

  [[noreturn]] void fail_corner(std::string_view text) const {
    scanner_.fail_at_word("expected a corner of a face, found " + quoted(text),
                          "write 1, 1/2, 1//3 or 1/2/3: numbers of vertex, texture coordinate, normal, counted from 1");
  }

  TextScanner scanner_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  MeshBuilder builder_;
  CountedWarnings warnings_;
  std::string object_, material_;
  std::vector<uint32_t> corners_, texture_;
  size_t unknown_begin_ = 0, unknown_end_ = 0;  // the first statement with an unknown name
};

}  // namespace

std::optional<Mesh> read_obj(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return read_or_null(name, bytes, diagnostics, [&] { return ObjReader(name, bytes, diagnostics).read(); });
}

}  // namespace ombre::formats
