// The rays of a picture and their hits.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "base/system/large_array.h"

namespace ombre::render {

struct Colour {
  float red, green, blue;  // linear RGB, 0 to 1
};

// The hits of a ray. Depths are mm in the view's frame, and infinite if the ray hits nothing.
struct RayHit {
  static constexpr float none = std::numeric_limits<float>::infinity();
  float surface;  // depth at which the ray enters the solid
  float end;      // depth at which no light is left
  Colour at_end;  // colour of the material there
  Colour veil;    // light added by translucent material before the end
  float passes;   // share of light that passes that material
  static constexpr RayHit nothing() { return {none, none, {}, {}, 1}; }
};

struct Film {
  int64_t width = 0, height = 0;  // rays
  double pixel_mm = 0;  // distance between rays in the picture plane; the plane's middle is the middle of the film
  int64_t samples = 1;  // a pixel of the picture consists of samples x samples rays
  double right_of(int64_t column) const { return (static_cast<double>(2 * column + 1 - width)) * 0.5 * pixel_mm; }
  double down_of(int64_t row) const { return (static_cast<double>(2 * row + 1 - height)) * 0.5 * pixel_mm; }
};

// The hits of the rays in some rows of the film.
class RayBand {
 public:
  RayBand() = default;
  // Constructs a band of rows [begin, end). Memory is allocated but not touched, so that the threads that fill it share
  // that work.
  RayBand(int64_t begin, int64_t end, int64_t width)
      : begin_(begin), end_(end), width_(width), hits_(unset_large_array<RayHit>(size())) {}

  bool has(int64_t column, int64_t row) const { return column >= 0 && column < width_ && row >= begin_ && row < end_; }
  RayHit& at(int64_t column, int64_t row) { return hits_[static_cast<size_t>((row - begin_) * width_ + column)]; }
  const RayHit& at(int64_t column, int64_t row) const {
    return hits_[static_cast<size_t>((row - begin_) * width_ + column)];
  }
  // Returns all hits, row by row.
  std::span<const RayHit> all() const { return {hits_.get(), size()}; }
  // Returns the hits of a row from column `first` up to `last`.
  std::span<RayHit> part(int64_t row, int64_t first, int64_t last) {
    return {&at(first, row), static_cast<size_t>(last - first)};
  }

 private:
  size_t size() const { return static_cast<size_t>(width_ * (end_ - begin_)); }

  int64_t begin_ = 0, end_ = 0, width_ = 0;  // rows of the film; columns
  LargeArray<RayHit> hits_;
};

}  // namespace ombre::render
