// Mathematical morphology on the voxels of a solid (Serra, Image Analysis and Mathematical Morphology, 1982).
#include <cmath>

#include "base/text/text.h"
#include "nodes/common/filter_stages.h"

namespace ombre::nodes {
namespace {

using design::StageValues;
using Flags = std::vector<uint8_t>;

// A row of the ball: its offset from the centre, and its extent along x in both directions.
struct BallRow {
  int64_t j = 0, k = 0, half = 0;
};

struct Ball {
  std::array<int64_t, 3> radius{};  // radius along each axis in cells
  std::vector<BallRow> rows;
};

Ball make_ball(double radius_mm, Vec3 cell_mm) {
  constexpr double rounding = 1e-9;
  const double limit = radius_mm * radius_mm * (1 + rounding);
  Ball ball;
  for (int axis = 0; axis < 3; ++axis)
    ball.radius[static_cast<size_t>(axis)] = static_cast<int64_t>(radius_mm / cell_mm[axis] * (1 + rounding));
  for (int64_t k = -ball.radius[2]; k <= ball.radius[2]; ++k)
    for (int64_t j = -ball.radius[1]; j <= ball.radius[1]; ++j) {
      const double y = static_cast<double>(j) * cell_mm.y, z = static_cast<double>(k) * cell_mm.z;
      const double rest = limit - y * y - z * z;
      if (rest >= 0) ball.rows.push_back({j, k, static_cast<int64_t>(std::sqrt(rest) / cell_mm.x)});
    }
  return ball;
}

// Flags in a box of cells, with x varying fastest.
struct FlagGrid {
  std::array<int64_t, 3> size{};
  Flags flags;
};

// Flags the cells within the ball of a cell with the value `wanted`. The result is smaller than the grid by the ball's
// radius on each side.
FlagGrid near(const FlagGrid& grid, const Ball& ball, uint8_t wanted, const StopFlag* stop) {
  FlagGrid made;
  for (size_t axis = 0; axis < 3; ++axis) made.size[axis] = grid.size[axis] - 2 * ball.radius[axis];
  made.flags.assign(static_cast<size_t>(made.size[0] * made.size[1] * made.size[2]), 0);
  // For each cell of a row, the number of wanted cells before it.
  std::vector<int64_t> before(static_cast<size_t>(grid.size[0]) + 1);
  for (int64_t k = 0; k < made.size[2]; ++k)
    for (int64_t j = 0; j < made.size[1]; ++j) {
      design::check_stop(stop);
      uint8_t* const to = made.flags.data() + (k * made.size[1] + j) * made.size[0];
      for (const BallRow& row : ball.rows) {
        const int64_t y = j + row.j + ball.radius[1], z = k + row.k + ball.radius[2];
        const uint8_t* const from = grid.flags.data() + (z * grid.size[1] + y) * grid.size[0];
        for (size_t i = 0; i < static_cast<size_t>(grid.size[0]); ++i)
          before[i + 1] = before[i] + (from[i] == wanted ? 1 : 0);
        if (before.back() == 0) continue;
        const auto count = [&](int64_t i) {
          const int64_t middle = i + ball.radius[0];
          return before[static_cast<size_t>(middle + row.half + 1)] - before[static_cast<size_t>(middle - row.half)];
        };
        for (int64_t i = 0; i < made.size[0]; ++i)
          if (count(i) > 0) to[i] = 1;
      }
    }
  return made;
}

FlagGrid dilated(const FlagGrid& grid, const Ball& ball, const StopFlag* stop) { return near(grid, ball, 1, stop); }

FlagGrid eroded(const FlagGrid& grid, const Ball& ball, const StopFlag* stop) {
  FlagGrid made = near(grid, ball, 0, stop);
  for (uint8_t& flag : made.flags) flag ^= 1;
  return made;
}

class MorphologyStage final : public design::HaloStage {
 public:
  MorphologyStage(const design::NodePtr& solid, Morphology what, double radius_mm, const std::optional<Vec3>& cell_mm)
      : solid_(solid), what_(what), radius_mm_(radius_mm), cell_mm_(cell_mm) {}

  std::string name() const override {
    const char* const names[] = {"dilate", "erode", "opening", "closing"};
    return names[static_cast<size_t>(what_)];
  }
  Hash content() const override { return hash_bytes(name() + ' ' + format_number(radius_mm_)); }
  Box bounds() const override {
    const Box box = solid_->bounds(design::design_space());
    return what_ == Morphology::dilate && !box.is_empty() ? box.expanded(radius_mm_) : box;
  }
  design::LatticeChoice lattice() const override { return {cell_mm_, false}; }

  std::vector<design::StageRead> reads() const override { return {{.solid = solid_, .inside = true}}; }
  std::vector<design::StageChannel> channels(const std::vector<design::StageChannel>&) const override {
    return {{"inside", {}, 0, true, {0, 1}}};
  }

  Reach reach(Vec3 cell_mm) const override {
    std::array<int64_t, 3> cells = make_ball(radius_mm_, cell_mm).radius;
    if (is_double())
      for (int64_t& n : cells) n *= 2;
    return {cells, cells};
  }

  void compute(const StageValues& read, StageValues& made, Vec3 cell_mm, const StopFlag* stop) const override {
    const Ball ball = make_ball(radius_mm_, cell_mm);
    FlagGrid grid{{read.box().size(0), read.box().size(1), read.box().size(2)}, {}};
    for (const float value : read.channel(0)) grid.flags.push_back(value != 0 ? 1 : 0);
    if (what_ == Morphology::erode || what_ == Morphology::opening) grid = eroded(grid, ball, stop);
    if (what_ != Morphology::erode) grid = dilated(grid, ball, stop);
    if (what_ == Morphology::closing) grid = eroded(grid, ball, stop);
    for (size_t n = 0; n < grid.flags.size(); ++n) made.channel(0)[n] = static_cast<float>(grid.flags[n]);
  }

 private:
  bool is_double() const { return what_ == Morphology::opening || what_ == Morphology::closing; }

  design::NodePtr solid_;
  Morphology what_;
  double radius_mm_;
  std::optional<Vec3> cell_mm_;
};

}  // namespace

design::StagePtr make_morphology_stage(const design::NodePtr& solid, Morphology what, double radius_mm,
                                       const std::optional<Vec3>& cell_mm) {
  return std::make_shared<MorphologyStage>(solid, what, radius_mm, cell_mm);
}

}  // namespace ombre::nodes
