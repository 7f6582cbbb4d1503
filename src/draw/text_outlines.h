// Texts as polygons.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/polygons.h"

namespace ombre::draw {

// The position of the text relative to the origin. A block extends from the top of the capital letters of its first
// line to the baseline of its last.
enum class TextSide { left, center, right };
enum class TextLevel {
  bottom,
  center,
  top,
  first_line,  // the baseline of the first line
};
// The meaning of the height of a text.
enum class TextMeasure {
  capitals,  // the letter H
  em,        // the font's size
  letters,   // from the lowest point of all lines to the highest, between which the level places the text then
};
// Other words than left, center and right, or than bottom, center and top, mean the left and the first line; other
// words than em and letters mean capitals.
TextSide side_called(std::string_view word);
TextLevel level_called(std::string_view word);
TextMeasure measure_called(std::string_view word);

struct TextLayout {
  double height_mm = 10;
  TextMeasure measure = TextMeasure::capitals;
  double line_spacing = 1;  // relative to the font's own
  double slant = 0;         // horizontal shift per unit of height
  TextSide side = TextSide::center;
  TextLevel level = TextLevel::center;
};

struct TextOutlines {
  std::vector<Ring> rings;           // mm; the inside has a winding number other than 0
  std::vector<std::string> missing;  // letters missing from the font, each once
};

// Returns false if this build lacks the libraries for text.
bool can_outline_text();

// Returns the outlines of a UTF-8 text. Each line is shaped for its script, in one direction. Curves are approximated
// to 1/2000 of the em. Null if the bytes are not a font with outlines.
std::optional<TextOutlines> outline_text(const std::string& font_bytes, int font_index, const std::string& text,
                                         const TextLayout& layout);

// Layout of a line of text as in OpenSCAD.
struct RunLayout {
  double em_mm = 10;
  double spacing = 1;                                               // factor for the advances
  int chords_per_curve = 4;                                         // chords for each curve of a letter
  std::string direction = "ltr", language = "en", script = "Latn";  // ltr, rtl, ttb, btt; ISO codes
  TextSide side = TextSide::left;
  TextLevel level = TextLevel::first_line;  // top, center and bottom relate to the letters that occur

  bool is_vertical() const { return direction == "ttb" || direction == "btt"; }
};

// Returns the outlines of one line of text, in which control characters count as letters. As in OpenSCAD 2021.01, the
// font's own instructions hint the letters, and advances and alignment are 1000/1024 of the font's values. Null if the
// bytes are not a font with outlines.
std::optional<TextOutlines> outline_run(const std::string& font_bytes, int font_index, const std::string& text,
                                        const RunLayout& layout);

// The place of such a line, in mm. The box holds all letters, `offset` is where the line begins on its baseline, and
// `advance` leads from there to where the next line would begin.
struct RunMeasures {
  Vec2 low, high;
  double ascent = 0, descent = 0;  // of the highest and the lowest letter above the baseline
  Vec2 offset, advance;
};

// Null if the bytes are not a font with outlines.
std::optional<RunMeasures> measure_run(const std::string& font_bytes, int font_index, const std::string& text,
                                       const RunLayout& layout);

// The measures of a font whose em is 1.
struct FontMeasures {
  double ascent = 0, descent = 0;  // as the font's designer set them
  double highest = 0, lowest = 0;  // of all letters
  double line_height = 0;
  std::string family, style;
};

// Null if the bytes are not a font with outlines.
std::optional<FontMeasures> measure_font(const std::string& font_bytes, int font_index);

}  // namespace ombre::draw
