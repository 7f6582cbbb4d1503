#include "draw/text_outlines.h"

namespace ombre::draw {

bool can_outline_text() {
#ifdef OMBRE_TEXT
  return true;
#else
  return false;
#endif
}

TextSide side_called(std::string_view word) {
  return word == "center" ? TextSide::center : word == "right" ? TextSide::right : TextSide::left;
}

TextLevel level_called(std::string_view word) {
  if (word == "bottom") return TextLevel::bottom;
  if (word == "center") return TextLevel::center;
  return word == "top" ? TextLevel::top : TextLevel::first_line;
}

TextMeasure measure_called(std::string_view word) {
  if (word == "em") return TextMeasure::em;
  return word == "letters" ? TextMeasure::letters : TextMeasure::capitals;
}

}  // namespace ombre::draw

#ifdef OMBRE_TEXT

#include <ft2build.h>
#include <hb.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

#include "base/math/curves.h"
#include "base/math/interval.h"
#include "base/system/not_copied.h"
#include "base/text/text.h"
#include "base/text/utf8.h"

namespace ombre::draw {
namespace {

constexpr double tolerance_em = 1.0 / 2000;
constexpr double usual_capital_em = 0.7;  // for fonts without an H

template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* pointer) const {
    destroy(pointer);
  }
};

// The size for which OpenSCAD 2021.01 hints letters before it scales them to any other: 100000/64 points at 100 dpi.
constexpr FT_F26Dot6 hinted_size = 100'000;
constexpr FT_UInt hinted_dpi = 100;
constexpr double points_per_inch = 72;

enum class Letters { as_drawn, hinted };

// A font opened by both libraries. Lengths are in its own units for letters as drawn, or in 1/64 pixel of the size for
// which letters are hinted.
class Face : NotCopied {
 public:
  Face(const std::string& bytes, int index, Letters letters = Letters::as_drawn) : letters_(letters) {
    if (FT_Init_FreeType(&library_) != 0) return;
    const auto* data = reinterpret_cast<const FT_Byte*>(bytes.data());
    if (FT_New_Memory_Face(library_, data, static_cast<FT_Long>(bytes.size()), index, &face_) != 0) return;
    const std::unique_ptr<hb_blob_t, Destroy<hb_blob_destroy>> blob(
        hb_blob_create(bytes.data(), static_cast<unsigned>(bytes.size()), HB_MEMORY_MODE_READONLY, nullptr, nullptr));
    const std::unique_ptr<hb_face_t, Destroy<hb_face_destroy>> face(
        hb_face_create(blob.get(), static_cast<unsigned>(index) & 0xFFFF));
    shaper_.reset(hb_font_create(face.get()));
    int x_scale = face_->units_per_EM, y_scale = face_->units_per_EM;
    if (letters == Letters::hinted && FT_Set_Char_Size(face_, 0, hinted_size, hinted_dpi, hinted_dpi) == 0) {
      x_scale = static_cast<int>(FT_MulFix(x_scale, face_->size->metrics.x_scale));
      y_scale = static_cast<int>(FT_MulFix(y_scale, face_->size->metrics.y_scale));
    }
    hb_font_set_scale(shaper_.get(), x_scale, y_scale);
  }
  ~Face() {
    if (face_) FT_Done_Face(face_);
    if (library_) FT_Done_FreeType(library_);
  }

  bool has_outlines() const { return face_ && shaper_ && FT_IS_SCALABLE(face_) && face_->units_per_EM > 0; }
  double em() const {
    return letters_ == Letters::hinted ? hinted_size * hinted_dpi / points_per_inch : face_->units_per_EM;
  }
  double line_height() const { return face_->height > 0 ? face_->height : 1.2 * em(); }
  hb_font_t* shaper() const { return shaper_.get(); }
  FontMeasures measures() const {
    const auto ems = [&](auto length) { return static_cast<double>(length) / em(); };
    const auto name = [](const char* text) { return std::string(text ? text : ""); };
    return {ems(face_->ascender), ems(face_->descender),    ems(face_->bbox.yMax),  ems(face_->bbox.yMin),
            line_height() / em(), name(face_->family_name), name(face_->style_name)};
  }

  // Returns the outline, or null if the glyph cannot be loaded.
  FT_Outline* outline(uint32_t glyph) const {
    constexpr FT_Int32 as_drawn = FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP;
    constexpr FT_Int32 hinted = FT_LOAD_DEFAULT | FT_LOAD_NO_BITMAP;
    if (FT_Load_Glyph(face_, glyph, letters_ == Letters::hinted ? hinted : as_drawn) != 0) return nullptr;
    return face_->glyph->format == FT_GLYPH_FORMAT_OUTLINE ? &face_->glyph->outline : nullptr;
  }

  double capital_height() const {
    const FT_UInt glyph = FT_Get_Char_Index(face_, 'H');
    FT_Outline* const letter = glyph == 0 ? nullptr : outline(glyph);
    if (!letter || letter->n_points == 0) return usual_capital_em * em();
    FT_BBox box;
    FT_Outline_Get_CBox(letter, &box);
    return box.yMax > 0 ? static_cast<double>(box.yMax) : usual_capital_em * em();
  }

 private:
  Letters letters_;
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
  std::unique_ptr<hb_font_t, Destroy<hb_font_destroy>> shaper_;
};

struct PlacedGlyph {
  uint32_t glyph;
  Vec2 at;         // relative to the beginning of its line
  uint32_t place;  // position of its letter in the text
};

struct Line {
  std::vector<PlacedGlyph> glyphs;
  double width = 0;
};

Line shape(const Face& face, const std::string& text) {
  const std::unique_ptr<hb_buffer_t, Destroy<hb_buffer_destroy>> buffer(hb_buffer_create());
  hb_buffer_add_utf8(buffer.get(), text.data(), static_cast<int>(text.size()), 0, static_cast<int>(text.size()));
  hb_buffer_set_language(buffer.get(), hb_language_from_string("en", -1));  // otherwise it would come from the locale
  hb_buffer_guess_segment_properties(buffer.get());
  hb_shape(face.shaper(), buffer.get(), nullptr, 0);
  unsigned count = 0;
  const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), &count);
  Line line;
  for (unsigned n = 0; n < count; ++n) {
    line.glyphs.push_back({infos[n].codepoint,
                           {line.width + places[n].x_offset, static_cast<double>(places[n].y_offset)},
                           infos[n].cluster});
    line.width += places[n].x_advance;
  }
  return line;
}

// Collects the rings of a glyph while FreeType decomposes its outline.
struct RingMaker {
  std::vector<Ring>* rings;
  Vec2 at;           // position of the glyph
  double tolerance;  // in the font's units
  int chords = 0;    // chords per curve; 0: as many as the tolerance requires

  Vec2 place(const FT_Vector& v) const { return {at.x + static_cast<double>(v.x), at.y + static_cast<double>(v.y)}; }
  Ring& ring() const { return rings->back(); }

  static const RingMaker& of(void* user) { return *static_cast<RingMaker*>(user); }
  static int move(const FT_Vector* to, void* user) {
    of(user).rings->push_back({of(user).place(*to)});
    return 0;
  }
  static int line(const FT_Vector* to, void* user) {
    of(user).ring().push_back(of(user).place(*to));
    return 0;
  }
  static int conic(const FT_Vector* by, const FT_Vector* to, void* user) {
    const Vec2 from = of(user).ring().back(), middle = of(user).place(*by), end = of(user).place(*to);
    const Vec2 first = from + (2.0 / 3) * (middle - from), second = end + (2.0 / 3) * (middle - end);
    of(user).append(Cubic<Vec2>{from, first, second, end});
    return 0;
  }
  static int cubic(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* user) {
    const RingMaker& maker = of(user);
    const Cubic<Vec2> curve{maker.ring().back(), maker.place(*first), maker.place(*second), maker.place(*to)};
    maker.append(curve);
    return 0;
  }

  void append(const Cubic<Vec2>& curve) const {
    if (chords == 0) return append_chords(curve, tolerance, ring());
    for (int n = 1; n <= chords; ++n)
      ring().push_back(n == chords ? curve.d : curve.at(static_cast<double>(n) / chords));
  }
};

// Removes repeated points, and rings of fewer than three points.
void tidy(std::vector<Ring>& rings) {
  for (Ring& ring : rings) {
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  }
  std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3; });
}

void append_rings(const Face& face, uint32_t glyph, Vec2 at, std::vector<Ring>& rings, int chords = 0) {
  FT_Outline* const outline = face.outline(glyph);
  if (!outline) return;
  RingMaker maker{&rings, at, tolerance_em * face.em(), chords};
  const FT_Outline_Funcs calls{RingMaker::move, RingMaker::line, RingMaker::conic, RingMaker::cubic, 0, 0};
  FT_Outline_Decompose(outline, &calls, &maker);
}

// Splits a text into lines and removes control characters.
std::vector<std::string> lines_of(std::string text) {
  std::erase(text, '\r');
  std::replace(text.begin(), text.end(), '\t', ' ');
  return split(text, '\n');
}

double first_foot(TextLevel level, double capitals, double below_first) {
  switch (level) {
    case TextLevel::bottom:
      return below_first;
    case TextLevel::center:
      return (below_first - capitals) / 2;
    case TextLevel::top:
      return -capitals;
    case TextLevel::first_line:
      break;
  }
  return 0;
}

double left_end(TextSide side, double width) {
  return side == TextSide::left ? 0 : side == TextSide::center ? -width / 2 : -width;
}

void note_missing(const std::string& text, size_t place, std::vector<std::string>& missing) {
  const std::string letter = text.substr(place, character_size(text, place));
  if (std::find(missing.begin(), missing.end(), letter) == missing.end()) missing.push_back(letter);
}

// A glyph of a run: where it is drawn, and how far the next one starts from it.
struct RunGlyph {
  uint32_t glyph;
  Vec2 offset, advance;
};

std::vector<RunGlyph> shape_run(const Face& face, const std::string& text, const RunLayout& layout) {
  const std::unique_ptr<hb_buffer_t, Destroy<hb_buffer_destroy>> buffer(hb_buffer_create());
  hb_buffer_add_utf8(buffer.get(), text.data(), static_cast<int>(text.size()), 0, static_cast<int>(text.size()));
  hb_buffer_set_direction(buffer.get(), hb_direction_from_string(layout.direction.c_str(), -1));
  hb_buffer_set_language(buffer.get(), hb_language_from_string(layout.language.c_str(), -1));
  hb_buffer_set_script(buffer.get(), hb_script_from_string(layout.script.c_str(), -1));
  hb_buffer_guess_segment_properties(buffer.get());  // properties that are not set above
  hb_shape(face.shaper(), buffer.get(), nullptr, 0);
  unsigned count = 0;
  const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), &count);
  std::vector<RunGlyph> run;
  for (unsigned n = 0; n < count; ++n)
    run.push_back({infos[n].codepoint,
                   {static_cast<double>(places[n].x_offset), static_cast<double>(places[n].y_offset)},
                   {static_cast<double>(places[n].x_advance), static_cast<double>(places[n].y_advance)}});
  return run;
}

// Returns the box around the points that define a letter, or nothing for a blank.
std::optional<FT_BBox> box_of(const Face& face, uint32_t glyph) {
  FT_Outline* const outline = face.outline(glyph);
  if (!outline || outline->n_points == 0) return std::nullopt;
  FT_BBox box;
  FT_Outline_Get_CBox(outline, &box);
  return box;
}

// Returns the lowest and the highest extent of the letters, in the font's units.
std::pair<double, double> reach_of(const Face& face, const std::vector<RunGlyph>& run) {
  double low = 0, high = 0;
  bool is_first = true;
  for (const RunGlyph& placed : run) {
    const auto box = box_of(face, placed.glyph);
    if (!box) continue;
    low = is_first ? static_cast<double>(box->yMin) : std::min(low, static_cast<double>(box->yMin));
    high = is_first ? static_cast<double>(box->yMax) : std::max(high, static_cast<double>(box->yMax));
    is_first = false;
  }
  return {low, high};
}

// Returns the width of the widest letter, in the font's units.
double widest_of(const Face& face, const std::vector<RunGlyph>& run) {
  double widest = 0;
  for (const RunGlyph& placed : run)
    if (const auto box = box_of(face, placed.glyph))
      widest = std::max(widest, static_cast<double>(box->xMax - box->xMin));
  return widest;
}

double rise_of(TextLevel level, double low, double high) {
  switch (level) {
    case TextLevel::top:
      return -high;
    case TextLevel::center:
      return -(low + high) / 2;
    case TextLevel::bottom:
      return -low;
    case TextLevel::first_line:
      break;
  }
  return 0;
}

// A run whose letters have their places, in the font's units.
struct PlacedRun {
  struct Letter {
    uint32_t glyph;
    Vec2 at;
  };
  std::vector<Letter> letters;
  double low = 0, high = 0;
  Vec2 offset, advance;
};

PlacedRun placed_run(const Face& face, const std::string& text, const RunLayout& layout) {
  constexpr double measure = 1000.0 / 1024;
  const std::vector<RunGlyph> run = shape_run(face, text, layout);
  PlacedRun result;
  for (const RunGlyph& placed : run) result.advance = result.advance + (measure * layout.spacing) * placed.advance;
  std::tie(result.low, result.high) = reach_of(face, run);
  if (layout.is_vertical()) {
    const double rise = rise_of(layout.level, 0, result.advance.y);  // letters follow each other downwards
    result.offset = {left_end(layout.side, measure * widest_of(face, run)), rise};
  } else {
    const double rise = rise_of(layout.level, result.low, result.high);
    result.offset = {left_end(layout.side, result.advance.x), measure * rise};
  }
  Vec2 at = result.offset;
  for (const RunGlyph& placed : run) {
    result.letters.push_back({placed.glyph, at + measure * placed.offset});
    at = at + (measure * layout.spacing) * placed.advance;
  }
  return result;
}

}  // namespace

std::optional<TextOutlines> outline_run(const std::string& font_bytes, int font_index, const std::string& text,
                                        const RunLayout& layout) {
  const Face face(font_bytes, font_index, Letters::hinted);
  if (!face.has_outlines()) return std::nullopt;
  TextOutlines outlines;
  for (const auto& [glyph, at] : placed_run(face, text, layout).letters)
    append_rings(face, glyph, at, outlines.rings, layout.chords_per_curve);
  const double mm = layout.em_mm / face.em();
  for (Ring& ring : outlines.rings)
    for (Vec2& p : ring) p = mm * p;
  tidy(outlines.rings);
  return outlines;
}

std::optional<RunMeasures> measure_run(const std::string& font_bytes, int font_index, const std::string& text,
                                       const RunLayout& layout) {
  const Face face(font_bytes, font_index, Letters::hinted);
  if (!face.has_outlines()) return std::nullopt;
  const PlacedRun run = placed_run(face, text, layout);
  const double mm = layout.em_mm / face.em();
  RunMeasures measures{{}, {}, mm * run.high, mm * run.low, mm * run.offset, mm * run.advance};
  bool is_first = true;
  for (const auto& [glyph, at] : run.letters) {
    const auto box = box_of(face, glyph);
    if (!box) continue;
    const Vec2 low = mm * (at + Vec2{static_cast<double>(box->xMin), static_cast<double>(box->yMin)});
    const Vec2 high = mm * (at + Vec2{static_cast<double>(box->xMax), static_cast<double>(box->yMax)});
    const auto& [least, most] = is_first ? std::pair(low, high) : std::pair(measures.low, measures.high);
    measures.low = {std::min(low.x, least.x), std::min(low.y, least.y)};
    measures.high = {std::max(high.x, most.x), std::max(high.y, most.y)};
    is_first = false;
  }
  return measures;
}

std::optional<FontMeasures> measure_font(const std::string& font_bytes, int font_index) {
  const Face face(font_bytes, font_index);
  return face.has_outlines() ? std::optional(face.measures()) : std::nullopt;
}

// Returns the least and the greatest y.
Interval heights_of(const std::vector<Ring>& rings) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Interval range{far, -far};
  for (const Ring& ring : rings) {
    for (const Vec2 p : ring) range = {std::min(range.lo, p.y), std::max(range.hi, p.y)};
  }
  return range;
}

// Lifts letters in units of the font, slants them, and makes millimetres of them.
void place(std::vector<Ring>& rings, double lift, double mm, double slant) {
  for (Ring& ring : rings) {
    for (Vec2& p : ring) {
      const double y = p.y + lift;
      p = {mm * (p.x + slant * y), mm * y};
    }
  }
}

std::optional<TextOutlines> outline_text(const std::string& font_bytes, int font_index, const std::string& text,
                                         const TextLayout& layout) {
  const Face face(font_bytes, font_index);
  if (!face.has_outlines()) return std::nullopt;
  const std::vector<std::string> lines = lines_of(text);
  const double line_height = face.line_height() * layout.line_spacing, capitals = face.capital_height();
  double foot = first_foot(layout.level, capitals, line_height * static_cast<double>(lines.size() - 1));
  TextOutlines outlines;
  for (const std::string& words : lines) {
    const Line line = shape(face, words);
    const double left = left_end(layout.side, line.width);
    for (const PlacedGlyph& placed : line.glyphs) {
      if (placed.glyph == 0) note_missing(words, placed.place, outlines.missing);
      append_rings(face, placed.glyph, {left + placed.at.x, foot + placed.at.y}, outlines.rings);
    }
    foot -= line_height;
  }
  double height = layout.measure == TextMeasure::em ? face.em() : capitals, lift = 0;
  if (const Interval letters = heights_of(outlines.rings);
      layout.measure == TextMeasure::letters && letters.hi > letters.lo) {
    height = letters.hi - letters.lo;
    if (layout.level != TextLevel::first_line) lift = first_foot(layout.level, height, 0) - letters.lo;
  }
  place(outlines.rings, lift, layout.height_mm / height, layout.slant);
  tidy(outlines.rings);
  return outlines;
}

}  // namespace ombre::draw

#else

namespace ombre::draw {

std::optional<TextOutlines> outline_text(const std::string&, int, const std::string&, const TextLayout&) {
  return std::nullopt;
}

std::optional<TextOutlines> outline_run(const std::string&, int, const std::string&, const RunLayout&) {
  return std::nullopt;
}

std::optional<RunMeasures> measure_run(const std::string&, int, const std::string&, const RunLayout&) {
  return std::nullopt;
}

std::optional<FontMeasures> measure_font(const std::string&, int) { return std::nullopt; }

}  // namespace ombre::draw

#endif
