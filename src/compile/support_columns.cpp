#include "compile/support_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "import/channels.h"

namespace ombre::compile {
namespace {

using importing::distance_channel;
using importing::inside_channel;

// Larger boxes are not asked column by column.
constexpr int64_t most_columns_asked = 1024;

using Cell = std::array<int64_t, 3>;

// Negative inside.
double distance_to(const Box& box, Vec3 p) {
  Vec3 beyond;
  double deepest = -Box::inf;
  for (int axis = 0; axis < 3; ++axis) {
    const double out = std::max(box.lo[axis] - p[axis], p[axis] - box.hi[axis]);
    beyond[axis] = std::max(out, 0.0);
    deepest = std::max(deepest, out);
  }
  return deepest > 0 ? length(beyond) : deepest;
}

class Columns final : public program::FieldSource {
 public:
  Columns(const voxel::Lattice& lattice, const Box& box, const std::vector<Stack>& stacks, Hash content)
      : lattice_(lattice), voxel_(lattice.voxel_mm()), box_(box), content_(content) {
    const auto columns = static_cast<size_t>(lattice.count[0] * lattice.count[1]);
    first_.assign(columns + 1, 0);
    for (const Stack& stack : stacks) ++first_[stack.column + 1];
    for (size_t c = 0; c < columns; ++c) first_[c + 1] += first_[c];
    stretches_.resize(stacks.size());
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Stack& stack : stacks) stretches_[next[stack.column]++] = {stack.bottom, stack.top};
  }

  std::string name() const override { return "support"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return box_; }

  int channel(std::string_view channel_name) const override { return importing::channel_of(channel_name); }

  double sample(int channel, Vec3 p) const override {
    if (channel == inside_channel) return box_.contains(p) && holds(cell_of(p)) ? 1 : 0;
    return std::max(distance_to(box_, p), distance_to_cells(p));
  }

  Interval range(int channel, const Box& box) const override {
    const Interval marks = inside_range(box);
    if (channel == inside_channel) return marks;
    if (!box.is_bounded()) return Interval::everything();
    const Vec3 center = box.center();
    const double value = sample(distance_channel, center), room = 0.5 * length(box.size());
    return outward(marks.hi == 0 ? std::max(0.0, value - room) : value - room,
                   marks.lo == 1 ? std::min(0.0, value + room) : value + room);
  }

 private:
  struct Stretch {
    int32_t bottom = 0, top = 0;
  };

  int64_t index(int axis, double mm) const {
    const double cells = std::floor((mm - lattice_.origin[axis]) / voxel_[axis]);
    return static_cast<int64_t>(std::clamp(cells, -2.0, static_cast<double>(count(axis)) + 1));
  }
  int64_t count(int axis) const { return lattice_.count[static_cast<size_t>(axis)]; }
  Cell cell_of(Vec3 p) const { return {index(0, p.x), index(1, p.y), index(2, p.z)}; }

  std::span<const Stretch> column(int64_t i, int64_t j) const {
    const auto c = static_cast<size_t>(i + j * count(0));
    return std::span(stretches_).subspan(first_[c], first_[c + 1] - first_[c]);
  }

  bool holds(const Cell& cell) const {
    if (cell[0] < 0 || cell[1] < 0 || cell[0] >= count(0) || cell[1] >= count(1)) return false;
    return std::ranges::any_of(column(cell[0], cell[1]),
                               [&](const Stretch& s) { return s.bottom <= cell[2] && cell[2] < s.top; });
  }

  Box box_of(const Cell& cell) const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<double>(cell[static_cast<size_t>(axis)]);
      box.lo[axis] = lattice_.origin[axis] + at * voxel_[axis];
      box.hi[axis] = lattice_.origin[axis] + (at + 1) * voxel_[axis];
    }
    return box;
  }

  // To the nearest cell of the other kind, as far as a neighbour reaches.
  double distance_to_cells(Vec3 p) const {
    const Cell own = cell_of(p);
    const bool is_inside = holds(own);
    double least = std::min({voxel_.x, voxel_.y, voxel_.z});
    for (int64_t n = 0; n < 27; ++n) {
      const Cell other{own[0] + n % 3 - 1, own[1] + n / 3 % 3 - 1, own[2] + n / 9 - 1};
      if (holds(other) != is_inside) least = std::min(least, std::max(0.0, distance_to(box_of(other), p)));
    }
    return is_inside ? -least : least;
  }

  Interval inside_range(const Box& box) const {
    const Box within = intersect(box, box_);
    if (within.is_empty()) return Interval(0);
    const Cell lo = cell_of(within.lo), hi = cell_of(within.hi);
    const int64_t i_end = std::min(hi[0] + 1, count(0)), j_end = std::min(hi[1] + 1, count(1));
    const int64_t i_begin = std::max<int64_t>(lo[0], 0), j_begin = std::max<int64_t>(lo[1], 0);
    if ((i_end - i_begin) * (j_end - j_begin) > most_columns_asked) return Interval(0, 1);
    bool is_full = within == box, is_empty = true;
    for (int64_t j = j_begin; j < j_end; ++j)
      for (int64_t i = i_begin; i < i_end; ++i) {
        bool holds_all = false;
        for (const Stretch& s : column(i, j)) {
          if (s.bottom <= hi[2] && lo[2] < s.top) is_empty = false;
          if (s.bottom <= lo[2] && hi[2] < s.top) holds_all = true;
        }
        is_full = is_full && holds_all;
        if (!is_full && !is_empty) return Interval(0, 1);
      }
    return is_empty ? Interval(0) : is_full ? Interval(1) : Interval(0, 1);
  }

  voxel::Lattice lattice_;
  Vec3 voxel_;
  Box box_;
  Hash content_;
  std::vector<uint32_t> first_;  // of each column's stretches, and their end
  std::vector<Stretch> stretches_;
};

}  // namespace

program::SourceField make_columns(const voxel::Lattice& lattice, const Box& box, const std::vector<Stack>& stacks,
                                  Hash content) {
  return std::make_shared<Columns>(lattice, box, stacks, content);
}

}  // namespace ombre::compile
