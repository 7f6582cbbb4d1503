#include "base/math/box_tree.h"

#include <utility>

namespace ombre {
namespace {

constexpr int bits = 21;  // bits of a coordinate along each axis

// Inserts two zero bits before each bit, to interleave three coordinates.
uint64_t spread(uint64_t n) {
  n = (n | n << 32) & 0x001F00000000FFFFU;
  n = (n | n << 16) & 0x001F0000FF0000FFU;
  n = (n | n << 8) & 0x100F00F00F00F00FU;
  n = (n | n << 4) & 0x10C30C30C30C30C3U;
  return (n | n << 2) & 0x1249249249249249U;
}

// Positions of box centres along a Morton (Z-order) curve.
class Curve {
 public:
  explicit Curve(const Box& whole) : whole_(whole) {
    for (int axis = 0; axis < 3; ++axis) {
      const double size = whole.size()[axis];
      scale_[axis] = size > 0 ? static_cast<double>((1 << bits) - 1) / size : 0;
    }
  }
  uint64_t place(const Box& box) const {
    uint64_t place = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double middle = 0.5 * (box.lo[axis] + box.hi[axis]) - whole_.lo[axis];
      place |= spread(static_cast<uint64_t>(std::max(0.0, middle * scale_[axis]))) << axis;
    }
    return place;
  }

 private:
  Box whole_;
  Vec3 scale_;
};

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) {
  if (boxes.empty()) return;
  Box whole;
  for (const Box& box : boxes) whole = hull(whole, box);
  const Curve curve(whole);
  std::vector<std::pair<uint64_t, uint32_t>> places;
  places.reserve(boxes.size());
  for (uint32_t n = 0; n < boxes.size(); ++n) places.emplace_back(curve.place(boxes[n]), n);
  std::ranges::sort(places);

  std::vector<Box> sorted;
  sorted.reserve(boxes.size());
  order_.reserve(boxes.size());
  for (const auto& [place, number] : places) {
    order_.push_back(number);
    sorted.push_back(boxes[number]);
  }
  levels_.push_back(std::move(sorted));
  do {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> level((below.size() + width - 1) / width);
    for (size_t n = 0; n < below.size(); ++n) level[n / width] = hull(level[n / width], below[n]);
    levels_.push_back(std::move(level));
  } while (levels_.back().size() > 1);
}

}  // namespace ombre
