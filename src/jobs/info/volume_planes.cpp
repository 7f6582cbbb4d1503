#include "jobs/info/volume_planes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sources/volume_file_parts.h"

namespace ombre::jobs {
namespace {

constexpr double longest_side = 480;  // pixels of the volume's longest side
constexpr uint32_t gap = 8;           // pixels between the planes

struct Plane {
  size_t right = 0, up = 1;  // axes of the volume
};

class Painter {
 public:
  explicit Painter(const formats::VoxelVolume& volume) : volume_(volume), range_(sources::shown_range(volume)) {
    for (size_t axis = 0; axis < 3; ++axis) {
      double step = 1;
      if (const auto& map = volume.space_from_index) {
        const int a = static_cast<int>(axis);
        step = length(Vec3{map->rows[0][a], map->rows[1][a], map->rows[2][a]});
      }
      sides_mm_[axis] = step * static_cast<double>(volume.count[axis]);
    }
    pixel_mm_ = std::max({sides_mm_[0], sides_mm_[1], sides_mm_[2]}) / longest_side;
  }

  PlanesPicture paint() {
    constexpr std::array<Plane, 3> planes{Plane{0, 1}, Plane{0, 2}, Plane{1, 2}};
    for (const Plane& plane : planes) {
      picture_.width += pixels(plane.right) + (picture_.width > 0 ? gap : 0);
      picture_.height = std::max(picture_.height, pixels(plane.up));
    }
    constexpr uint8_t white = 255;
    picture_.rgba.assign(size_t{4} * picture_.width * picture_.height, white);
    uint32_t left = 0;
    for (const Plane& plane : planes) {
      paint(plane, left);
      left += pixels(plane.right) + gap;
    }
    return std::move(picture_);
  }

 private:
  uint32_t pixels(size_t axis) const {
    return static_cast<uint32_t>(std::max(1.0, std::round(sides_mm_[axis] / pixel_mm_)));
  }
  int64_t voxel(size_t axis, uint32_t pixel) const {
    const double share = (pixel + 0.5) / pixels(axis);
    return std::min(static_cast<int64_t>(share * static_cast<double>(volume_.count[axis])), volume_.count[axis] - 1);
  }

  void paint(const Plane& plane, uint32_t left) {
    const size_t across = 3 - plane.right - plane.up;
    formats::visit_numbers(volume_, [&](const auto& numbers) {
      std::array<int64_t, 3> at{};
      at[across] = volume_.count[across] / 2;
      for (uint32_t row = 0; row < pixels(plane.up); ++row)
        for (uint32_t column = 0; column < pixels(plane.right); ++column) {
          at[plane.right] = voxel(plane.right, column);
          at[plane.up] = voxel(plane.up, pixels(plane.up) - 1 - row);
          const int64_t n = (at[2] * volume_.count[1] + at[1]) * volume_.count[0] + at[0];
          put(row, left + column, static_cast<double>(numbers[static_cast<size_t>(n)]));
        }
    });
  }

  void put(uint32_t row, uint32_t column, double value) {
    constexpr double white = 255;
    const double share = std::clamp((value - range_.lo) / (range_.hi - range_.lo), 0.0, 1.0);
    std::fill_n(&picture_.rgba[size_t{4} * (size_t{row} * picture_.width + column)], 3,
                static_cast<uint8_t>(std::round(white * share)));
  }

  const formats::VoxelVolume& volume_;
  Interval range_;
  std::array<double, 3> sides_mm_{};
  double pixel_mm_ = 1;
  PlanesPicture picture_;
};

}  // namespace

PlanesPicture draw_planes(const formats::VoxelVolume& volume) { return Painter(volume).paint(); }

}  // namespace ombre::jobs
