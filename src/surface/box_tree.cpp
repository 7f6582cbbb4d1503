#include "surface/box_tree.h"

#include <algorithm>
#include <numeric>

namespace ombre::surface {

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!boxes_.empty()) build(0, 0, order_.size());
}

void BoxTree::build(size_t node, size_t begin, size_t end) {
  if (nodes_.size() <= node) nodes_.resize(node + 1);
  Box box;
  for (size_t n = begin; n < end; ++n) box = hull(box, boxes_[order_[n]]);
  nodes_[node] = box;
  if (end - begin <= leaf) return;
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto middle_of = [&](uint32_t f) { return boxes_[f].lo[axis] + boxes_[f].hi[axis]; };
  const size_t middle = (begin + end) / 2;
  const auto at = [&](size_t n) { return order_.begin() + static_cast<std::ptrdiff_t>(n); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](uint32_t a, uint32_t b) { return std::pair(middle_of(a), a) < std::pair(middle_of(b), b); });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

}  // namespace ombre::surface
