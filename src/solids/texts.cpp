#include "solids/texts.h"

#include <algorithm>

#include "base/text/text.h"
#include "draw/font_search.h"
#include "draw/text_outlines.h"
#include "formats/containers/file.h"
#include "solids/fragments.h"
#include "solids/regions.h"

namespace ombre::solids {
namespace {

constexpr const char* usual_font = "Liberation Sans";

struct FontName {
  std::string family = usual_font;
  bool is_bold = false, is_italic = false;
};

// Parses a font name such as "Family:style=Bold Italic".
FontName font_name(const std::string& text) {
  FontName name;
  const std::vector<std::string> words = split(text, ':');
  if (!words.empty() && !words[0].empty()) name.family = words[0];
  for (size_t n = 1; n < words.size(); ++n) {
    const std::string style = to_lower(words[n]);
    if (!style.starts_with("style=")) continue;
    name.is_bold |= style.find("bold") != std::string::npos;
    name.is_italic |= style.find("italic") != std::string::npos || style.find("oblique") != std::string::npos;
  }
  return name;
}

constexpr double em_of_size = 100.0 / 72;

draw::RunLayout layout_of(const Text& text) {
  draw::RunLayout layout{em_of_size * text.size, text.spacing};
  layout.chords_per_curve = std::max(2, edges_of_circle(text.size, text.fragments) / 8 + 1);
  layout.direction = text.direction;
  layout.language = text.language;
  layout.script = text.script;
  layout.side = draw::side_called(text.horizontal);
  layout.level = draw::level_called(text.vertical);
  return layout;
}

// Returns the font of a text. If there is none, or the text is too long, adds an error and returns nothing.
std::optional<draw::FoundFont> font_of(const Text& text, const SourceRange& where, Diagnostics& messages) {
  constexpr size_t most_bytes = 100'000;
  if (text.text.size() > most_bytes) {
    messages.error(where, "a text has at most " + std::to_string(most_bytes) + " bytes");
    return std::nullopt;
  }
  if (!draw::can_outline_text()) {
    messages.error(where, "this ombre was built without HarfBuzz and fontconfig, which texts need",
                   "install libharfbuzz-dev and libfontconfig-dev, configure with -DOMBRE_TEXT=ON and build again");
    return std::nullopt;
  }
  const FontName name = font_name(text.font);
  auto font = draw::search_font_files(text.font_files, name.family, name.is_bold, name.is_italic);
  if (!font) font = draw::search_font(name.family, name.is_bold, name.is_italic);
  if (!font)
    messages.error(where, "there is no font \"" + name.family + "\", and none to take its place",
                   "install fonts-liberation or fonts-dejavu-core");
  return font;
}

}  // namespace

Region region_of_text(const Text& text, const SourceRange& where, Diagnostics& messages) {
  if (text.text.empty() || !(text.size > 0)) return {};
  const auto font = font_of(text, where, messages);
  if (!font) return {};
  const auto outlines = draw::outline_run(formats::read_file(font->file), font->index, text.text, layout_of(text));
  return outlines ? wound_region_of(outlines->rings) : Region{};
}

std::optional<draw::RunMeasures> measures_of(const Text& text, const SourceRange& where, Diagnostics& messages) {
  if (text.text.empty() || !(text.size > 0)) return draw::RunMeasures{};
  const auto font = font_of(text, where, messages);
  if (!font) return std::nullopt;
  return draw::measure_run(formats::read_file(font->file), font->index, text.text, layout_of(text));
}

std::optional<draw::FontMeasures> font_measures_of(const Text& text, const SourceRange& where, Diagnostics& messages) {
  const auto font = font_of(text, where, messages);
  if (!font) return std::nullopt;
  auto measures = draw::measure_font(formats::read_file(font->file), font->index);
  if (!measures) return std::nullopt;
  for (double* length :
       {&measures->ascent, &measures->descent, &measures->highest, &measures->lowest, &measures->line_height})
    *length *= em_of_size * text.size;
  return measures;
}

}  // namespace ombre::solids
