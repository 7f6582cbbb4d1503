// Layers of flags, a bit for each voxel, and the growth of their regions by shapes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/math/vec.h"

namespace ombre::compile {

class BitLayer {
 public:
  BitLayer() = default;
  BitLayer(int64_t width, int64_t height)
      : width_(width), height_(height), words_((width + 63) / 64), bits_(static_cast<size_t>(words_ * height)) {}

  int64_t width() const { return width_; }
  int64_t height() const { return height_; }
  int64_t words() const { return words_; }  // of a row; bits behind the width are 0
  uint64_t* row(int64_t j) { return bits_.data() + j * words_; }
  const uint64_t* row(int64_t j) const { return bits_.data() + j * words_; }
  bool get(int64_t i, int64_t j) const { return (row(j)[i / 64] >> (i % 64) & 1) != 0; }
  void set(int64_t i, int64_t j) { row(j)[i / 64] |= uint64_t{1} << (i % 64); }
  // Sets the voxels [begin, end) of a row.
  void set(int64_t j, int64_t begin, int64_t end);

  uint64_t count() const;
  void invert();
  BitLayer& operator&=(const BitLayer& other);
  BitLayer& operator|=(const BitLayer& other);
  BitLayer& remove(const BitLayer& other);

 private:
  int64_t width_ = 0, height_ = 0, words_ = 0;
  std::vector<uint64_t> bits_;
};

// Calls `found(begin, end)` for each run of set voxels in a row, from the least on.
template <class Found>
void each_run(const BitLayer& layer, int64_t j, const Found& found) {
  const uint64_t* const row = layer.row(j);
  const int64_t width = layer.width();
  const auto next = [&](int64_t from, bool wanted) {
    for (int64_t w = from / 64; w * 64 < width; ++w) {
      uint64_t bits = wanted ? row[w] : ~row[w];
      if (w == from / 64) bits &= ~uint64_t{0} << (from % 64);
      if (bits != 0) return std::min(width, w * 64 + std::countr_zero(bits));
    }
    return width;
  };
  for (int64_t begin = next(0, true); begin < width;) {
    const int64_t end = next(begin, false);
    found(begin, end);
    begin = end < width ? next(end, true) : width;
  }
}

// Layers from the layer `first` on.
struct BitLayers {
  int64_t first = 0;
  std::vector<BitLayer> layers;

  int64_t end() const { return first + static_cast<int64_t>(layers.size()); }
  const BitLayer& at(int64_t k) const { return layers[static_cast<size_t>(k - first)]; }
};

BitLayers inverted(BitLayers region);

// A set of offsets in voxels, as spans [from, to] along x, which contain 0.
struct OffsetSpan {
  int64_t j = 0, k = 0, from = 0, to = 0;
};
struct Offsets {
  std::vector<OffsetSpan> spans;

  Offsets reflected() const;
  int64_t reach() const;  // the greatest offset along any axis
};

// The voxels of a ball of this diameter, so that a wall of as many voxels as the diameter takes holds it.
Offsets ball_offsets(double diameter_mm, Vec3 voxel_mm);
// Offsets between voxels whose centres are at most this far from each other.
Offsets offsets_within(double distance_mm, Vec3 voxel_mm);
// Offsets between voxels whose nearest faces, edges or corners are less than `distance_mm` from each other.
Offsets offsets_nearer(double distance_mm, Vec3 voxel_mm);

// Returns layers [begin, end) of the union of copies of the region, one for each offset. Nothing is outside the layers.
BitLayers dilated(const BitLayers& region, const Offsets& offsets, int64_t begin, int64_t end);
// Returns layers [begin, end) of the places whose copies of the offsets lie in the region. Everything is outside.
BitLayers eroded(BitLayers region, const Offsets& offsets, int64_t begin, int64_t end);

}  // namespace ombre::compile
