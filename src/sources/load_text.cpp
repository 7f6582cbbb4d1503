// Loads texts as field sources for designs.
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "draw/font_files.h"
#include "draw/font_search.h"
#include "draw/text_outlines.h"
#include "import/fields/polygon_source.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

constexpr const char* usual_font = "DejaVu Sans";
constexpr size_t most_letters = 10'000;
constexpr double slant_of_italics = 0.2;  // for fonts without an italic face

struct Font {
  std::string file;
  int index = 0;
  double slant = 0;
};

bool wants_bold(const TextRequest& use) { return use.style == "bold" || use.style == "bold_italic"; }
bool wants_italic(const TextRequest& use) { return use.style == "italic" || use.style == "bold_italic"; }

bool is_font_file(const std::string& name) {
  const std::string lower = to_lower(name);
  return lower.ends_with(".ttf") || lower.ends_with(".otf") || lower.ends_with(".ttc");
}

void no_font(const std::string& name, const Reader& reader) {
  reader.diagnostics.error(Code::unknown_font, reader.where,
                           "there is no font \"" + name + "\", and none to take its place",
                           "install fonts-dejavu-core, or give the path of a .ttf or .otf file");
}

// Returns a font of the system, with a warning if it differs from the request.
std::optional<Font> system_font(const std::string& name, const TextRequest& use, const Reader& reader) {
  auto found = draw::search_font(name, wants_bold(use), wants_italic(use));
  if (found && !found->has_name) {
    const auto usual = draw::search_font(usual_font, wants_bold(use), wants_italic(use));
    if (usual && usual->has_name) found = usual;
    reader.diagnostics.warning(Code::unknown_font, reader.where,
                               "there is no font \"" + name + "\": " + found->family + " takes its place",
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

// Finds the font. The name of a file becomes the path where the file was found.
std::optional<Font> find_font(TextRequest& use, sources::Loading& loading) {
  const Reader& reader = loading.reader();
  const std::string& name = use.font.name;
  if (!is_font_file(name)) return system_font(name, use, reader);
  FilePath file{name, {}};
  if (!loading.find(file)) return std::nullopt;
  if (use.style != "regular") {
    reader.diagnostics.error(reader.where, "a font that is a file has one style",
                             "leave style out, or give the file with these letters");
    return std::nullopt;
  }
  use.font.name = file.path;
  return Font{file.path};
}

draw::TextLayout layout_of(const TextRequest& use, double slant) {
  return {use.height_mm, draw::measure_called(use.measure.text()), use.line_spacing,
          slant,         draw::side_called(use.h_align.text()),    draw::level_called(use.v_align.text())};
}

Hash key_of_text(const TextRequest& use, double slant) {
  sources::Key key("text of a font");
  for (const Choice choice : {use.style, use.h_align, use.v_align, use.measure}) key.add(choice.text());
  return key.add(use.font.content).add(use.text).add(use.height_mm).add(use.line_spacing).add(slant).hash();
}

void warn_of_missing(const std::vector<std::string>& missing, const std::string& font, const Reader& reader) {
  if (missing.empty()) return;
  constexpr size_t most_named = 10;
  std::vector<std::string> named(missing.begin(), missing.begin() + std::min(missing.size(), most_named));
  reader.diagnostics.warning(
      reader.where,
      "the font \"" + font + "\" has no letter for " + join(named, " ") + (missing.size() > most_named ? " ..." : ""),
      "a sign of its own stands in their place; another font may have them");
}

}  // namespace

std::shared_ptr<const program::FieldSource> TextRequest::load(sources::Loading& loading) {
  const auto fail = [](const Reader& reader, const std::string& message, const Phrase& hint = {}) {
    reader.diagnostics.error(reader.where, message, hint);
    return nullptr;
  };
  if (!draw::can_outline_text())
    return fail(loading.reader(), "this ombre was built without HarfBuzz and fontconfig, which texts need",
                "install libharfbuzz-dev and libfontconfig-dev, configure with -DOMBRE_TEXT=ON and build again");
  if (count_code_points(text) > most_letters)
    return fail(loading.reader(), "a text has at most " + format_count(most_letters) + " letters");
  const auto found = find_font(*this, loading);
  FilePath file{found ? found->file : "", {}};
  if (!found || !loading.read_content(file)) return nullptr;
  font.content = hash_bytes(file.content.hex() + std::to_string(found->index));

  using Made = sources::Loading::Made<Result>;
  return loading.cached<Result>(key_of_text(*this, found->slant), font.name, [&](const Reader& reader) -> Made {
    auto outlines = draw::outline_text(*loading.bytes(file), found->index, text, layout_of(*this, found->slant));
    if (!outlines) return {fail(reader, found->file + " is not a font with outlines that can be read"), 0};
    if (outlines->rings.empty())
      return {fail(reader, "text has no letters that can be seen",
                   "write for example " + spelled::either("text(\"A1\")", "\"text\": \"A1\"", "ombre.text(\"A1\")")),
              0};
    warn_of_missing(outlines->missing, font.name, reader);
    constexpr size_t bytes_per_letter = 20'000;
    return {importing::make_polygon_source("text", {std::move(outlines->rings), {}}), bytes_per_letter * text.size()};
  });
}

}  // namespace ombre::design
