#include "jobs/stacks/marked_layer.h"

#include <algorithm>
#include <cmath>

#include "export/picture_file.h"

namespace ombre::compile {
namespace {

constexpr double longest_side = 800;
constexpr formats::Rgba paper{250, 250, 248, 255};

// Returns the colour half as strong, over the paper.
formats::Rgba pale(const formats::Rgba& colour) {
  formats::Rgba result = paper;
  for (size_t n = 0; n < 3; ++n) {
    const int strength = colour[3] / 2;
    result[n] = static_cast<uint8_t>((colour[n] * strength + paper[n] * (255 - strength)) / 255);
  }
  return result;
}

// The voxels [begin, end) under a pixel along an axis; at least one.
struct Under {
  int64_t begin, end;
  Under(uint32_t pixel, uint32_t pixels, int64_t voxels)
      : begin(int64_t{pixel} * voxels / pixels), end(std::max(begin + 1, (int64_t{pixel} + 1) * voxels / pixels)) {}
};

}  // namespace

std::string marked_layer(const voxel::Lattice& lattice, const std::function<formats::Rgba(size_t voxel)>& colour,
                         const std::vector<uint8_t>& flags) {
  const Vec3 size = lattice.box().size();
  const double scale = longest_side / std::max(size.x, size.y);
  const auto pixels = [&](double mm) { return static_cast<uint32_t>(std::max(1.0, std::round(scale * mm))); };
  exporting::Picture picture(pixels(size.x), pixels(size.y), paper);
  for (uint32_t row = 0; row < picture.height; ++row) {
    const Under y(picture.height - 1 - row, picture.height, lattice.count[1]);
    for (uint32_t column = 0; column < picture.width; ++column) {
      const Under x(column, picture.width, lattice.count[0]);
      uint8_t mark = 0;
      for (int64_t j = y.begin; j < y.end; ++j)
        for (int64_t i = x.begin; i < x.end; ++i)
          mark = std::max(mark, flags[static_cast<size_t>(j * lattice.count[0] + i)]);
      const auto voxel = static_cast<size_t>(y.begin * lattice.count[0] + x.begin);
      picture.set(column, row, mark > 0 ? mark_colours[mark] : pale(colour(voxel)));
    }
  }
  return formats::encode_png(picture.width, picture.height, picture.rgba);
}

}  // namespace ombre::compile
