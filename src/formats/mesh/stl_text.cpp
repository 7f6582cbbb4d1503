// Reads STL as text: solid NAME, facets, endsolid NAME; any number of solids.
#include "formats/mesh/stl_text.h"

#include "base/text/text.h"
#include "formats/containers/counted_warnings.h"
#include "formats/containers/text_scanner.h"
#include "formats/mesh/mesh_builder.h"
#include "formats/mesh/vertex_merger.h"

namespace ombre::formats {
namespace {

class StlTextReader {
 public:
  StlTextReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : scanner_(name, bytes, diagnostics), name_(name), diagnostics_(diagnostics) {}

  Mesh read() {
    while (!at_end()) {
      begin_solid();
      while (read_facet()) continue;
    }
    if (builder_.triangle_count() == 0) scanner_.fail_here("this STL has no facets");
    warnings_.report(name_, diagnostics_);
    return builder_.finish(merger_.take_places()).mesh;
  }

 private:
  // Skips padding: DOS ended texts with Ctrl-Z, and some programs fill blocks with zero bytes.
  bool at_end() {
    TextScanner ahead(scanner_);
    return ahead.word().find_first_not_of(std::string_view("\x1A\0", 2)) == std::string_view::npos && ahead.at_end();
  }

  // Returns the next word in small letters, without the zero bytes that may fill it up.
  std::string next() { return to_lower(before_zeros(scanner_.word())); }
  static std::string_view before_zeros(std::string_view text) { return text.substr(0, text.find('\0')); }

  void expect(std::string_view keyword, std::string_view where) { expect(keyword, where, next()); }

  void expect(std::string_view keyword, std::string_view where, const std::string& found) {
    if (found == keyword) return;
    if (found.empty())
      scanner_.fail_here("this STL is cut short: expected \"" + std::string(keyword) + "\" where " +
                         std::string(where) + ", but the file ends here");
    scanner_.fail_at_word("expected \"" + std::string(keyword) + "\" where " + std::string(where) + ", found " +
                          formats::quoted(found));
  }

  // Returns true for a keyword written as one word, or as two by FORTRAN programs: "endloop", "end loop".
  bool is_pair(const std::string& found, std::string_view first, std::string_view second) {
    if (found == std::string(first) + std::string(second)) return true;
    if (found != first) return false;
    TextScanner ahead(scanner_);
    if (to_lower(ahead.word()) != second) return false;
    scanner_.word();
    return true;
  }

  void begin_solid() {
    const size_t before = scanner_.position();
    const std::string found = next();
    if (found != "facet") {
      expect("solid", "a solid begins", found);
      builder_.start_group(name_of_solid());
    } else {
      scanner_.go_to(before);
      builder_.start_group("");
    }
    facets_ = 0;
  }

  // Returns the rest of the line, up to a facet that begins in it.
  std::string name_of_solid() {
    scanner_.at_line_end();
    const size_t begin = scanner_.position();
    const std::string_view line = scanner_.rest_of_line();
    const std::string lower = ' ' + to_lower(line) + ' ';
    const size_t facet = lower.find(" facet normal ");
    if (facet == std::string::npos) return std::string(trim(before_zeros(line)));
    scanner_.go_to(begin + facet);
    return std::string(trim(line.substr(0, facet)));
  }

  // Reads a facet. Returns false at the end of the solid.
  bool read_facet() {
    const size_t before = scanner_.position();
    const std::string found = next();
    // Some programs write the name of the solid without a blank.
    if (found.starts_with("endsolid") || is_pair(found, "end", "solid")) {
      scanner_.rest_of_line();
      return false;
    }
    if (facets_ > 0 && (found.empty() || found == "solid")) {
      scanner_.go_to(before);
      warnings_.add("a solid ends without \"endsolid\"; its facets are read",
                    "solids end without \"endsolid\"; their facets are read");
      return false;
    }
    if (found.empty())
      scanner_.fail_here("this STL is cut short: expected \"facet\" or \"endsolid\", but the file ends here");
    if (found != "facet") scanner_.fail_at_word("expected \"facet\" or \"endsolid\", found " + formats::quoted(found));
    pass_normal();
    read_corners();
    if (const std::string end = next(); !is_pair(end, "end", "facet")) expect("endfacet", "a facet ends", end);
    ++facets_;
    return true;
  }

  // Skips the normal, which follows from the corners; many files contain incorrect ones.
  void pass_normal() {
    constexpr std::string_view where = "a facet's corners begin";
    std::string found = next();
    if (found != "outer" && found != "outerloop") {
      expect("normal", "a facet begins", found);
      found = next();
      for (int i = 0; i < 3 && found != "outer" && found != "outerloop"; ++i) found = next();
    }
    if (found == "outerloop") return;
    expect("outer", where, found);
    expect("loop", where);
  }

  // Reads three corners, or more if a program has written polygons.
  void read_corners() {
    corners_.clear();
    points_.clear();
    for (;;) {
      const std::string found = next();
      if (corners_.size() >= 3) {
        if (is_pair(found, "end", "loop")) break;
        if (found != "vertex") expect("endloop", "a facet has its corners", found);
      }
      expect("vertex", "one of three corners is due", found);
      points_.push_back(scanner_.point("a coordinate of a corner"));
      corners_.push_back(merger_.add(points_.back()));
    }
    if (corners_.size() == 3) return builder_.add_polygon(corners_);
    for (const Corners& of : cutter_.cut(points_)) {
      const std::array<uint32_t, 3> triangle{corners_[of[0]], corners_[of[1]], corners_[of[2]]};
      builder_.add_polygon(triangle);
    }
  }

  TextScanner scanner_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  MeshBuilder builder_;
  VertexMerger merger_;
  PolygonCutter cutter_;
  CountedWarnings warnings_;
  std::vector<uint32_t> corners_;
  std::vector<Vec3> points_;
  size_t facets_ = 0;  // number of facets in this solid
};

}  // namespace

Mesh read_stl_text(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return StlTextReader(name, bytes, diagnostics).read();
}

}  // namespace ombre::formats
