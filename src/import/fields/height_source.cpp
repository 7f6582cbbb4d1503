// Images as height fields.
#include "import/fields/height_source.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/system/assert.h"

namespace ombre::importing {
namespace {

// The least and the greatest value of blocks of pixels, in a pyramid: a block of the next level covers two by two.
class Extremes {
 public:
  explicit Extremes(const GrayImage& image) {
    levels_.push_back({image.width, image.height, image.values, image.values});
    while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(coarser(levels_.back()));
  }

  // Returns the range over columns and rows lo to hi, both included, which must lie in the image.
  Interval over(std::array<uint32_t, 2> lo, std::array<uint32_t, 2> hi) const {
    constexpr uint32_t few = 4;
    size_t level = 0;
    while (std::max(hi[0] - lo[0], hi[1] - lo[1]) >= few) {
      for (uint32_t* at : {&lo[0], &lo[1], &hi[0], &hi[1]}) *at /= 2;
      ++level;
    }
    const Level& cells = levels_[level];
    Interval found(1, 0);
    for (uint32_t row = lo[1]; row <= hi[1]; ++row)
      for (uint32_t column = lo[0]; column <= hi[0]; ++column) {
        const size_t cell = size_t{row} * cells.width + column;
        found.lo = std::min(found.lo, static_cast<double>(cells.least[cell]));
        found.hi = std::max(found.hi, static_cast<double>(cells.greatest[cell]));
      }
    return found;
  }

 private:
  struct Level {
    uint32_t width, height;
    std::vector<float> least, greatest;
  };

  static Level coarser(const Level& fine) {
    Level level{(fine.width + 1) / 2, (fine.height + 1) / 2, {}, {}};
    for (uint32_t row = 0; row < level.height; ++row)
      for (uint32_t column = 0; column < level.width; ++column) {
        float least = 1, greatest = 0;
        for (uint32_t r = 2 * row; r < std::min(2 * row + 2, fine.height); ++r)
          for (uint32_t c = 2 * column; c < std::min(2 * column + 2, fine.width); ++c) {
            least = std::min(least, fine.least[size_t{r} * fine.width + c]);
            greatest = std::max(greatest, fine.greatest[size_t{r} * fine.width + c]);
          }
        level.least.push_back(least);
        level.greatest.push_back(greatest);
      }
    return level;
  }

  std::vector<Level> levels_;
};

// A place between two pixels; `share` is its distance from the first of them.
struct Between {
  uint32_t first, next;
  double share;
};

Between between(double at, uint32_t count) {
  const double place = std::clamp(at - 0.5, 0.0, static_cast<double>(count - 1));
  const auto first = static_cast<uint32_t>(place);
  return {first, std::min(first + 1, count - 1), place - first};
}

class HeightSource final : public program::NamedSource {
 public:
  HeightSource(std::string name, GrayImage image, Hash content)
      : NamedSource(std::move(name), content), image_(std::move(image)), extremes_(image_) {}

  Box bounds() const override {
    return {{0, 0, -Box::inf}, {static_cast<double>(image_.width), static_cast<double>(image_.height), Box::inf}};
  }
  int channel(std::string_view channel_name) const override { return channel_name == "value" ? 0 : -1; }

  double sample(int, Vec3 p) const override {
    if (std::isnan(p.x) || std::isnan(p.y)) return p.x + p.y;
    const Between column = between(p.x, image_.width), row = between(image_.height - p.y, image_.height);
    const double upper = mixed(value(column.first, row.first), value(column.next, row.first), column.share);
    const double lower = mixed(value(column.first, row.next), value(column.next, row.next), column.share);
    return mixed(upper, lower, row.share);
  }

  Interval range(int, const Box& box) const override {
    constexpr double rounding = 1e-12;
    const Between left = between(box.lo.x, image_.width), right = between(box.hi.x, image_.width);
    const Between top = between(image_.height - box.hi.y, image_.height);
    const Between bottom = between(image_.height - box.lo.y, image_.height);
    const Interval found = extremes_.over({left.first, top.first}, {right.next, bottom.next});
    return {found.lo - rounding, found.hi + rounding};
  }

 private:
  double value(uint32_t column, uint32_t row) const {
    return static_cast<double>(image_.values[size_t{row} * image_.width + column]);
  }
  static double mixed(double a, double b, double share) { return a + share * (b - a); }

  GrayImage image_;
  Extremes extremes_;
};

}  // namespace

std::array<double, 2> steepest_steps(const GrayImage& image) {
  std::array<double, 2> steps{0, 0};
  const auto value = [&](uint32_t column, uint32_t row) {
    return static_cast<double>(image.values[size_t{row} * image.width + column]);
  };
  for (uint32_t row = 0; row < image.height; ++row)
    for (uint32_t column = 0; column < image.width; ++column) {
      if (column > 0) steps[0] = std::max(steps[0], std::abs(value(column, row) - value(column - 1, row)));
      if (row > 0) steps[1] = std::max(steps[1], std::abs(value(column, row) - value(column, row - 1)));
    }
  return steps;
}

program::SourceField make_height_source(std::string name, GrayImage image, Hash content) {
  ASSERT(image.width > 0 && image.height > 0 && image.values.size() == size_t{image.width} * image.height);
  return std::make_shared<HeightSource>(std::move(name), std::move(image), content);
}

}  // namespace ombre::importing
