// Draws layers in a grid as one picture, in true proportions.
#include "export/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "base/system/assert.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "draw/pen.h"
#include "formats/containers/file.h"

namespace ombre::exporting {
namespace {

constexpr uint32_t sheet_width = 1600, tallest_tile = 800, margin = 16, label_height = 16;
constexpr int label_size = 14;
constexpr formats::Rgba paper{250, 250, 248, 255}, tile_colour{229, 232, 236, 255};
constexpr draw::Rgb ink{90, 90, 90};

// Pixels [left, right) x [top, bottom).
struct Crop {
  uint32_t left = UINT32_MAX, top = UINT32_MAX, right = 0, bottom = 0;

  void include(uint32_t column, uint32_t row) {
    left = std::min(left, column);
    right = std::max(right, column + 1);
    top = std::min(top, row);
    bottom = std::max(bottom, row + 1);
  }
  bool is_empty() const { return left >= right; }
  uint32_t width() const { return right - left; }
  uint32_t height() const { return bottom - top; }
};

// Layout of the tiles on the sheet.
struct Grid {
  uint32_t columns = 1, rows = 1, tile_width = 1, tile_height = 1;

  uint32_t cell_height() const { return tile_height + label_height + margin; }
  uint32_t sheet_height() const { return margin + rows * cell_height(); }
  uint32_t left(uint32_t tile) const { return margin + tile % columns * (tile_width + margin); }
  uint32_t top(uint32_t tile) const { return margin + tile / columns * cell_height(); }
};

void require_size(const formats::PngImage& image, const std::string& file, uint32_t width, uint32_t height) {
  if (image.width != width || image.height != height)
    throw Error(Code::file_content, file + " has another size than the layers before it", {{"file", file}});
}

formats::PngImage read(const std::string& path) { return formats::decode_png(formats::read_file(path), path); }

void lay_over(Picture& picture, const SheetImage& sheet_image, const formats::PngImage& image,
              const formats::Rgba& background) {
  for (uint32_t row = 0; row < image.height; ++row)
    for (uint32_t column = 0; column < image.width; ++column)
      if (const formats::Rgba colour = image.colour(column, row); colour != background)
        picture.set(column, row, sheet_image.ink.value_or(colour));
}

// Reads the images of a layer, laid over each other.
formats::PngImage read(const SheetLayer& layer, const SheetStyle& style) {
  formats::PngImage first = read(layer.images.front().file);
  if (layer.images.size() == 1 && !layer.images.front().ink) return first;
  Picture picture(first.width, first.height, style.background);
  for (const SheetImage& image : layer.images) {
    const formats::PngImage next = &image == &layer.images.front() ? first : read(image.file);
    require_size(next, image.file, picture.width, picture.height);
    lay_over(picture, image, next, style.background);
  }
  first.format = ImageFormat::rgba;
  first.pixels = std::move(picture.rgba);
  return first;
}

Crop occupied(const std::vector<SheetLayer>& layers, const SheetStyle& style) {
  Crop crop;
  uint32_t width = 0, height = 0;
  for (const SheetLayer& layer : layers) {
    const formats::PngImage image = read(layer, style);
    if (width == 0) {
      width = image.width;
      height = image.height;
    }
    require_size(image, layer.images.front().file, width, height);
    for (uint32_t row = 0; row < height; ++row)
      for (uint32_t column = 0; column < width; ++column)
        if (image.colour(column, row) != style.background) crop.include(column, row);
  }
  return crop.is_empty() ? Crop{0, 0, width, height} : crop;
}

Grid arrange(uint32_t count, double width_mm, double height_mm) {
  Grid grid;
  grid.columns = std::min<uint32_t>(count, static_cast<uint32_t>(std::ceil(std::sqrt(count * 1.5))));
  // Uses fewer columns if that fills all rows.
  for (uint32_t fewer = grid.columns; fewer * fewer >= count; --fewer)
    if (count % fewer == 0) {
      grid.columns = fewer;
      break;
    }
  // Tall parts are placed in one row as long as their tiles remain wide enough to be visible.
  if (height_mm > 2 * width_mm) grid.columns = std::min<uint32_t>(count, 2 * grid.columns);
  grid.rows = (count + grid.columns - 1) / grid.columns;
  const uint32_t widest = (sheet_width - margin) / grid.columns - margin;
  const double scale = std::min(widest / width_mm, tallest_tile / height_mm);
  grid.tile_width = std::max<uint32_t>(1, static_cast<uint32_t>(std::lround(width_mm * scale)));
  grid.tile_height = std::max<uint32_t>(1, static_cast<uint32_t>(std::lround(height_mm * scale)));
  return grid;
}

// Returns the range of source pixels under pixel i of n; it contains at least one.
std::pair<uint32_t, uint32_t> sources(uint32_t i, uint32_t n, uint32_t begin, uint32_t count) {
  const auto first = static_cast<uint32_t>(uint64_t{i} * count / n);
  const auto last = static_cast<uint32_t>((uint64_t{i} + 1) * count / n);
  return {begin + first, begin + std::max(last, first + 1)};
}

// Returns the mean colour of a box of pixels, each blended over the tile's white.
formats::Rgba mean(const formats::PngImage& image, std::pair<uint32_t, uint32_t> columns,
                   std::pair<uint32_t, uint32_t> rows) {
  std::array<uint64_t, 3> sums{};
  for (uint32_t row = rows.first; row < rows.second; ++row) {
    for (uint32_t column = columns.first; column < columns.second; ++column) {
      const formats::Rgba colour = image.colour(column, row);
      for (size_t i = 0; i < 3; ++i)
        sums[i] += colour[i] * uint64_t{colour[3]} + tile_colour[i] * uint64_t{255U - colour[3]};
    }
  }
  const uint64_t weight = uint64_t{255} * (columns.second - columns.first) * (rows.second - rows.first);
  const auto channel = [&](size_t i) { return static_cast<uint8_t>((sums[i] + weight / 2) / weight); };
  return {channel(0), channel(1), channel(2), 255};
}

void draw_tile(Picture& sheet, const Grid& grid, uint32_t tile, const formats::PngImage& image, const Crop& crop) {
  for (uint32_t y = 0; y < grid.tile_height; ++y) {
    const auto rows = sources(y, grid.tile_height, crop.top, crop.height());
    for (uint32_t x = 0; x < grid.tile_width; ++x) {
      const auto columns = sources(x, grid.tile_width, crop.left, crop.width());
      sheet.set(grid.left(tile) + x, grid.top(tile) + y, mean(image, columns, rows));
    }
  }
}

void draw_label(draw::Pen& pen, Picture& sheet, const Grid& grid, uint32_t tile, const SheetLayer& layer) {
  const draw::Canvas canvas{sheet.width, sheet.height, &sheet.rgba};
  const std::string number = std::to_string(layer.layer), height = format_rounded(layer.z_mm) + " mm";
  const double left = grid.left(tile), baseline = grid.top(tile) + grid.tile_height + label_height;
  pen.write(canvas, {left, baseline}, number, label_size, ink);
  // The label includes the height if there is room for it.
  const double spare = grid.tile_width - pen.text_width(height, label_size);
  if (pen.text_width(number + ' ', label_size) <= spare)
    pen.write(canvas, {left + spare, baseline}, height, label_size, ink);
}

}  // namespace

Picture draw_contact_sheet(const std::vector<SheetLayer>& layers, const SheetStyle& style) {
  ASSERT(!layers.empty());
  const Crop crop = occupied(layers, style);
  const Grid grid = arrange(static_cast<uint32_t>(layers.size()), crop.width() * style.pixel_width_mm,
                            crop.height() * style.pixel_height_mm);
  Picture sheet(margin + grid.columns * (grid.tile_width + margin), grid.sheet_height(), paper);
  std::optional<draw::Pen> pen;
  if (draw::can_draw()) pen.emplace();
  for (uint32_t tile = 0; tile < layers.size(); ++tile) {
    draw_tile(sheet, grid, tile, read(layers[tile], style), crop);
    if (pen) draw_label(*pen, sheet, grid, tile, layers[tile]);
  }
  return sheet;
}

}  // namespace ombre::exporting
