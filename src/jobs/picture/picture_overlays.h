// Draws outlines and names of parts and materials on pictures.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "draw/pen.h"
#include "jobs/picture/picture_request.h"

namespace ombre::compile {

// The number of the part or material that each pixel shows, rows from the top; -1: none.
struct PictureNumbers {
  int64_t width = 0, height = 0;
  std::vector<int16_t> numbers;

  int16_t at(int64_t column, int64_t row) const;  // -1 outside of the picture
};

// Darkens pixels whose neighbours show something else.
void draw_outlines(std::vector<uint8_t>& rgba, const PictureNumbers& numbers);
// Writes a name in the middle of the area with its number, if there is room for a letter or two.
void draw_names(std::vector<uint8_t>& rgba, const PictureNumbers& numbers, const std::map<int, std::string>& names,
                draw::Pen& pen);

}  // namespace ombre::compile
