// The rays of a picture, and what each meets.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "base/system/large_array.h"

namespace ombre::render {

struct Colour {
  float red, green, blue;  // linear, 0 to 1
};

// Depths are mm in the view's frame; infinite where the ray meets nothing.
struct RayHit {
  static constexpr float none = std::numeric_limits<float>::infinity();
  float surface;  // where it enters what is inside
  float end;      // where no light comes through any more
  Colour at_end;  // the material there
  Colour veil;    // what translucent material before the end adds
  float passes;   // the share of light that it lets through
  static constexpr RayHit nothing() { return {none, none, {}, {}, 1}; }
};

struct Film {
  int64_t width = 0, height = 0;  // rays
  double pixel_mm = 0;            // from ray to ray, in the picture plane; its middle is the middle of the film
  int64_t samples = 1;            // so many by so many rays make up a pixel of the picture
  double right_of(int64_t column) const { return (static_cast<double>(2 * column + 1 - width)) * 0.5 * pixel_mm; }
  double down_of(int64_t row) const { return (static_cast<double>(2 * row + 1 - height)) * 0.5 * pixel_mm; }
};

// What the rays of some rows of the film meet.
class RayBand {
 public:
  RayBand() = default;
  // Rows [begin, end). Memory is asked for, but not touched: that is shared by the threads that fill it.
  RayBand(int64_t begin, int64_t end, int64_t width)
      : begin_(begin), end_(end), width_(width), hits_(unset_large_array<RayHit>(size())) {}

  bool has(int64_t column, int64_t row) const { return column >= 0 && column < width_ && row >= begin_ && row < end_; }
  RayHit& at(int64_t column, int64_t row) { return hits_[static_cast<size_t>((row - begin_) * width_ + column)]; }
  const RayHit& at(int64_t column, int64_t row) const {
    return hits_[static_cast<size_t>((row - begin_) * width_ + column)];
  }
  // Row by row.
  std::span<const RayHit> all() const { return {hits_.get(), size()}; }
  // Rays of a row, from one column up to another.
  std::span<RayHit> part(int64_t row, int64_t first, int64_t last) {
    return {&at(first, row), static_cast<size_t>(last - first)};
  }

 private:
  size_t size() const { return static_cast<size_t>(width_ * (end_ - begin_)); }

  int64_t begin_ = 0, end_ = 0, width_ = 0;  // rows, columns
  LargeArray<RayHit> hits_;
};

}  // namespace ombre::render
