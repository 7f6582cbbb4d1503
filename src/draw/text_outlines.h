// Texts as polygons.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/polygons.h"

namespace ombre::draw {

// Where the text lies from the origin. A block reaches from the top of the capital letters of its first line to the
// foot of its last.
enum class TextSide { left, center, right };
enum class TextLevel {
  bottom,
  center,
  top,
  first_line,  // the foot of the first line
};

struct TextLayout {
  double height_mm = 10;
  bool is_height_of_capitals = true;  // else of the em, the font's size
  double line_spacing = 1;            // times the font's own
  double slant = 0;                   // how far to the right for each step up
  TextSide side = TextSide::center;
  TextLevel level = TextLevel::center;
};

struct TextOutlines {
  std::vector<Ring> rings;           // mm; inside is where the winding number is not 0
  std::vector<std::string> missing;  // letters that the font lacks, each once
};

// False where this was built without the libraries for texts.
bool can_outline_text();

// Lines of a text in UTF-8, shaped as their script wants it, each in one direction. Curves are followed to 1/2000 of
// the em. Nothing when the bytes are no font with outlines.
std::optional<TextOutlines> outline_text(const std::string& font_bytes, int font_index, const std::string& text,
                                         const TextLayout& layout);

// How one line of text is laid out where OpenSCAD lays it out.
struct RunLayout {
  double em_mm = 10;
  double spacing = 1;                                               // times the advances
  int chords_per_curve = 4;                                         // of each of a letter's curves
  std::string direction = "ltr", language = "en", script = "Latn";  // ltr, rtl, ttb, btt; ISO codes
  TextSide side = TextSide::left;
  TextLevel level = TextLevel::first_line;  // top, center and bottom: of the letters that are there
};

// One line of a text, control characters among its letters. As in OpenSCAD 2021.01, advances and alignment are
// 1000/1024 of what the font says. Nothing when the bytes are no font with outlines.
std::optional<TextOutlines> outline_run(const std::string& font_bytes, int font_index, const std::string& text,
                                        const RunLayout& layout);

}  // namespace ombre::draw
