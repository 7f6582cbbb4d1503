#include "compile/shape_loader.h"

#include "base/error.h"
#include "base/text.h"
#include "base/utf8.h"
#include "compile/find_file.h"
#include "draw/font_files.h"
#include "draw/font_search.h"
#include "draw/text_outlines.h"
#include "formats/file.h"
#include "import/polygon_source.h"
#include "import/polygon_walls.h"

namespace ombre::compile {
namespace {

constexpr const char* usual_font = "DejaVu Sans";
constexpr size_t most_letters = 10'000;
constexpr double slant_of_italics = 0.2;  // where a font has none of its own

struct Font {
  std::string file;
  int index = 0;
  double slant = 0;
};

bool wants_bold(const design::TextUse& use) { return use.style == "bold" || use.style == "bold_italic"; }
bool wants_italic(const design::TextUse& use) { return use.style == "italic" || use.style == "bold_italic"; }

bool is_font_file(const std::string& name) {
  const std::string lower = to_lower(name);
  return lower.ends_with(".ttf") || lower.ends_with(".otf") || lower.ends_with(".ttc");
}

void no_font(const std::string& name, const design::Reader& reader) {
  reader.diagnostics.error(reader.where, "there is no font \"" + name + "\", and none to take its place",
                           "install fonts-dejavu-core, or give the path of a .ttf or .otf file");
}

// A font of the system, with a warning for what it is not.
std::optional<Font> system_font(const std::string& name, const design::TextUse& use, const design::Reader& reader) {
  auto found = draw::search_font(name, wants_bold(use), wants_italic(use));
  if (found && !found->has_name) {
    const auto usual = draw::search_font(usual_font, wants_bold(use), wants_italic(use));
    if (usual && usual->has_name) found = usual;
    reader.diagnostics.warning(reader.where, "there is no font \"" + name + "\": " + found->family + " takes its place",
                               "install it, or give the path of a .ttf or .otf file");
  }
  if (!found) {
    no_font(name, reader);
    return std::nullopt;
  }
  if (wants_bold(use) && !found->is_bold)
    reader.diagnostics.warning(reader.where, "the font " + found->family + " has no bold letters: they are regular");
  return Font{found->file, found->index, wants_italic(use) && !found->is_italic ? slant_of_italics : 0};
}

std::optional<Font> find_font(const std::string& name, const design::TextUse& use, const design::Reader& reader) {
  if (!is_font_file(name)) return system_font(name, use, reader);
  const auto file = find_file(name, reader.where, reader.diagnostics);
  if (!file) return std::nullopt;
  if (use.style != "regular") {
    reader.diagnostics.error(reader.where, "a font that is a file has one style",
                             "leave style out, or give the file with these letters");
    return std::nullopt;
  }
  return Font{*file};
}

draw::TextLayout layout_of(const design::TextUse& use, double slant) {
  draw::TextLayout layout{use.height_mm, use.measure == "capitals", use.line_spacing, slant};
  layout.side = use.h_align == "left"    ? draw::TextSide::left
                : use.h_align == "right" ? draw::TextSide::right
                                         : draw::TextSide::center;
  layout.level = use.v_align == "bottom"   ? draw::TextLevel::bottom
                 : use.v_align == "top"    ? draw::TextLevel::top
                 : use.v_align == "center" ? draw::TextLevel::center
                                           : draw::TextLevel::first_line;
  return layout;
}

void warn_of_missing(const std::vector<std::string>& missing, const std::string& font, const design::Reader& reader) {
  if (missing.empty()) return;
  constexpr size_t most_named = 10;
  std::vector<std::string> named(missing.begin(), missing.begin() + std::min(missing.size(), most_named));
  reader.diagnostics.warning(
      reader.where,
      "the font \"" + font + "\" has no letter for " + join(named, " ") + (missing.size() > most_named ? " ..." : ""),
      "a sign of its own stands in their place; another font may have them");
}

}  // namespace

program::SourceField load_polygons(Polygons polygons, bool turns, const design::Reader& reader) {
  for (const auto* rings : {&polygons.solid, &polygons.holes})
    for (const Ring& ring : *rings) {
      const auto edges = importing::find_self_crossing(ring);
      if (!edges) continue;
      reader.diagnostics.warning(reader.where,
                                 "the polygon crosses itself: its edges behind points " +
                                     std::to_string((*edges)[0] + 1) + " and " + std::to_string((*edges)[1] + 1) +
                                     " meet",
                                 "all that it goes round counts as inside");
    }
  return importing::make_polygon_source("polygon", std::move(polygons), {turns});
}

program::SourceField load_text(design::FontName& font, const design::TextUse& use, const design::Reader& reader) {
  const auto fail = [&](const std::string& message, const std::string& hint = "") {
    reader.diagnostics.error(reader.where, message, hint);
    return nullptr;
  };
  if (!draw::can_outline_text())
    return fail("this ombre was built without HarfBuzz and fontconfig, which texts need",
                "install libharfbuzz-dev and libfontconfig-dev, configure with -DOMBRE_TEXT=ON and build again");
  if (count_code_points(use.text) > most_letters)
    return fail("a text has at most " + format_count(most_letters) + " letters");
  const auto found = find_font(font.name, use, reader);
  if (!found) return nullptr;
  const std::string bytes = formats::read_file(found->file);
  font.content = hash_bytes(hash_bytes(bytes).hex() + std::to_string(found->index));
  auto outlines = draw::outline_text(bytes, found->index, use.text, layout_of(use, found->slant));
  if (!outlines) return fail(found->file + " is not a font with outlines that can be read");
  if (outlines->rings.empty()) return fail("text has no letters that can be seen", "write for example text(\"A1\")");
  warn_of_missing(outlines->missing, font.name, reader);
  return importing::make_polygon_source("text", {std::move(outlines->rings), {}});
}

}  // namespace ombre::compile
