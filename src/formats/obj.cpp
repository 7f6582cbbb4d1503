// Wavefront OBJ: vertices, texture coordinates, faces, and the names of objects, groups and materials.
#include <algorithm>
#include <array>
#include <charconv>

#include "base/text.h"
#include "formats/mesh.h"
#include "formats/mesh_builder.h"
#include "formats/text_scanner.h"

namespace ombre::formats {
namespace {

// Statements without a bearing on the surface.
constexpr std::array<std::string_view, 38> passed_over{
    "vn",    "s",     "mtllib",   "l",        "p",    "vp",     "cstype", "deg",        "bmat",      "step",
    "curv",  "curv2", "surf",     "parm",     "trim", "hole",   "scrv",   "sp",         "end",       "con",
    "mg",    "bevel", "c_interp", "d_interp", "lod",  "maplib", "usemap", "shadow_obj", "trace_obj", "ctech",
    "stech", "call",  "csh",      "bsp",      "bzp",  "cdc",    "cdp",    "res"};

class ObjReader {
 public:
  ObjReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : scanner_(name, bytes, diagnostics, {'#', true}), name_(name), diagnostics_(diagnostics) {}

  Mesh read() {
    while (!scanner_.at_end()) {
      read_statement(scanner_.word_in_line());
      scanner_.next_line();
    }
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
    if (std::find(passed_over.begin(), passed_over.end(), keyword) != passed_over.end()) return;
    scanner_.fail_at_word("an OBJ file has no statement " + quoted(keyword),
                          "v, vt, f, o, g and usemtl make up a mesh; # begins a comment");
  }

  void start_group() { builder_.start_group(object_.empty() ? material_ : object_, material_); }

  // Weights and colours may follow; next_line() passes over them.
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
  }

  void read_texture_coordinate() {
    need_in_line("a texture coordinate");
    const double u = scanner_.coordinate("a texture coordinate");
    const double v = scanner_.at_line_end() ? 0 : scanner_.coordinate("a texture coordinate");
    if (builder_.texture_coordinate_count() >= MeshBuilder::most_vertices)
      scanner_.fail_here("there are too many texture coordinates");
    builder_.add_texture_coordinate(u, v);
  }

  void need_in_line(std::string_view what) {
    if (scanner_.at_line_end()) scanner_.fail_here("expected " + std::string(what) + ", but the line ends here");
  }

  void read_face() {
    corners_.clear();
    texture_.clear();
    while (!scanner_.at_line_end()) read_corner(scanner_.word_in_line());
    if (corners_.size() < 3)
      scanner_.fail_here("a face needs at least 3 corners, this one has " + std::to_string(corners_.size()));
    // A face of which only some corners have texture coordinates counts as one without.
    if (texture_.size() != corners_.size()) texture_.clear();
    builder_.add_polygon(corners_, texture_);
  }

  // V, V/VT, V//VN or V/VT/VN.
  void read_corner(std::string_view text) {
    const char* at = text.data();
    const char* const end = at + text.size();
    corners_.push_back(resolve(read_index(at, end, text), builder_.vertex_count(), "vertex", "vertices", text));
    if (at == end) return;
    if (*at++ != '/') fail_corner(text);
    if (at != end && *at != '/')
      texture_.push_back(resolve(read_index(at, end, text), builder_.texture_coordinate_count(), "texture coordinate",
                                 "texture coordinates", text));
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

  // Indices count from 1; negative ones count back from the last.
  uint32_t resolve(int64_t index, size_t count, std::string_view one, std::string_view many, std::string_view corner) {
    const auto known = static_cast<int64_t>(count);
    if (index > known || index < -known)
      scanner_.fail_at_word("the corner " + quoted(corner) + " uses " + std::string(one) + " " + std::to_string(index) +
                            ", but " + format_count(count) + " " + std::string(many) + " come before it");
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
  std::string object_, material_;
  std::vector<uint32_t> corners_, texture_;
};

}  // namespace

std::optional<Mesh> read_obj(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  try {
    if (bytes.empty()) fail(diagnostics, name, "the file is empty");
    return ObjReader(name, bytes, diagnostics).read();
  } catch (const DesignError&) {
    return std::nullopt;
  }
}

}  // namespace ombre::formats
