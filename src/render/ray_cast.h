// Casts a ray through each pixel of a picture and notes what it meets.
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "base/tasks.h"
#include "render/scene.h"

namespace ombre::render {

struct Colour {
  float red = 0, green = 0, blue = 0;  // linear, 0 to 1
};

// Depths are mm in the view's frame; infinite where the ray meets nothing.
struct RayHit {
  static constexpr float none = std::numeric_limits<float>::infinity();
  float surface = none;  // where it enters what is inside
  float end = none;      // where no light comes through any more
  Colour at_end;         // the material there
  Colour veil;           // what translucent material before the end adds
  float passes = 1;      // the share of light that it lets through
};

struct Film {
  int64_t width = 0, height = 0;  // rays
  double pixel_mm = 0;            // from ray to ray, in the picture plane; its middle is the middle of the film
  int64_t samples = 1;            // so many by so many rays make up a pixel of the picture
  double right_of(int64_t column) const { return (static_cast<double>(2 * column + 1 - width)) * 0.5 * pixel_mm; }
  double down_of(int64_t row) const { return (static_cast<double>(2 * row + 1 - height)) * 0.5 * pixel_mm; }
};

// What the rays of some rows of the film meet.
struct RayBand {
  int64_t begin = 0, end = 0, width = 0;  // rows, columns
  std::vector<RayHit> hits;               // row by row
  RayHit& at(int64_t column, int64_t row) { return hits[static_cast<size_t>((row - begin) * width + column)]; }
  const RayHit& at(int64_t column, int64_t row) const {
    return hits[static_cast<size_t>((row - begin) * width + column)];
  }
};

// Of rows [begin, end), which may lie beyond the film. The same whatever the band, but for sums over translucent
// material, and the number of threads.
// Surfaces are found to some thousandths of a pixel of the picture; what is thinner than a quarter of one along the
// ray may be missed. `is_stopped` is asked now and then; if it says so, the rest is left empty.
RayBand cast_rays(const Scene& scene, const Film& film, int64_t begin, int64_t end, int threads,
                  const std::function<bool()>& is_stopped);

}  // namespace ombre::render
