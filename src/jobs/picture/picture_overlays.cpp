#include "jobs/picture/picture_overlays.h"

#include <algorithm>
#include <cmath>

#include "render/annotations.h"

namespace ombre::compile {
namespace {

constexpr draw::Rgb ink{30, 32, 36}, halo{255, 255, 255};

// The area of a number's pixels, and the pixel that is nearest to its middle.
struct Area {
  int64_t pixels = 0;
  double right = 0, down = 0;  // sums
  double nearest = 0;
  draw::Spot middle{};
};

std::map<int, Area> areas_of(const PictureNumbers& numbers) {
  std::map<int, Area> areas;
  const auto for_all = [&](const auto& visit) {
    for (int64_t row = 0; row < numbers.height; ++row)
      for (int64_t column = 0; column < numbers.width; ++column)
        if (const int16_t number = numbers.at(column, row); number >= 0) visit(areas[number], column, row);
  };
  for_all([](Area& area, int64_t column, int64_t row) {
    area.right += static_cast<double>(column);
    area.down += static_cast<double>(row);
    if (++area.pixels == 1) area.nearest = HUGE_VAL;
  });
  for_all([](Area& area, int64_t column, int64_t row) {
    const auto count = static_cast<double>(area.pixels);
    const double right = static_cast<double>(column) - area.right / count;
    const double down = static_cast<double>(row) - area.down / count;
    if (right * right + down * down >= area.nearest) return;
    area.nearest = right * right + down * down;
    area.middle = {static_cast<double>(column), static_cast<double>(row)};
  });
  return areas;
}

void write_with_halo(const draw::Canvas& canvas, draw::Spot left, const std::string& text, int size, draw::Pen& pen) {
  const double width = std::max(1.0, size / 8.0);
  for (const double right : {-width, 0.0, width})
    for (const double down : {-width, 0.0, width})
      if (right != 0 || down != 0) pen.write(canvas, {left.right + right, left.down + down}, text, size, halo);
  pen.write(canvas, left, text, size, ink);
}

}  // namespace

int16_t PictureNumbers::at(int64_t column, int64_t row) const {
  if (column < 0 || row < 0 || column >= width || row >= height) return -1;
  return numbers[static_cast<size_t>(row * width + column)];
}

void draw_outlines(std::vector<uint8_t>& rgba, const PictureNumbers& numbers) {
  constexpr double strongest = 4;  // number of different neighbours of eight; a straight border has three
  for (int64_t row = 0; row < numbers.height; ++row)
    for (int64_t column = 0; column < numbers.width; ++column) {
      const int16_t own = numbers.at(column, row);
      int others = 0;
      for (int64_t down = -1; down <= 1; ++down)
        for (int64_t right = -1; right <= 1; ++right) others += numbers.at(column + right, row + down) != own;
      const bool is_rim = row == 0 || column == 0 || row + 1 == numbers.height || column + 1 == numbers.width;
      if (others == 0 || (is_rim && own < 0)) continue;
      const double share = std::min(1.0, others / strongest);
      uint8_t* pixel = &rgba[static_cast<size_t>(row * numbers.width + column) * 4];
      for (size_t n = 0; n < 3; ++n)
        pixel[n] = static_cast<uint8_t>(std::lround(pixel[n] + share * (ink[n] - pixel[n])));
      pixel[3] = static_cast<uint8_t>(std::max<long>(pixel[3], std::lround(255 * share)));
    }
}

void draw_names(std::vector<uint8_t>& rgba, const PictureNumbers& numbers, const std::map<int, std::string>& names,
                draw::Pen& pen) {
  const draw::Canvas canvas{numbers.width, numbers.height, &rgba};
  const int size = render::lay_out(numbers.width, numbers.height, {}, pen).text_size;
  for (const auto& [number, area] : areas_of(numbers)) {
    const auto name = names.find(number);
    if (name == names.end() || area.pixels < int64_t{size} * size) continue;
    const double width = pen.text_width(name->second, size);
    const double most = std::max(0.0, static_cast<double>(numbers.width) - width);
    const double left = std::clamp(area.middle.right - width / 2, 0.0, most);
    write_with_halo(canvas, {left, area.middle.down + size * 0.36}, name->second, size, pen);
  }
}

}  // namespace ombre::compile
