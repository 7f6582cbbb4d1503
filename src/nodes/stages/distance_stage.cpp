// Distances to a solid's surface, computed by passing nearest points from voxel to voxel.
#include <algorithm>
#include <cmath>
#include <span>

#include "base/text/text.h"
#include "nodes/common/whole_stages.h"

namespace ombre::nodes {
namespace {

using design::StageValues;

using Place = std::array<float, 3>;  // mm from the first voxel's centre

// Keeps for each voxel the nearest known point of the surface.
class Sweeping {
 public:
  Sweeping(const std::vector<float>& values, const IndexBox& box, Vec3 cell, const StopFlag* stop)
      : cell_(cell), values_(values), stop_(stop) {
    for (size_t a = 0; a < 3; ++a) size_[a] = box.size(static_cast<int>(a));
    step_ = {1, size_[0], size_[0] * size_[1]};
    // Allocates row by row, so that it can be stopped: it takes time to get that much memory.
    nearest_.reserve(values.size());
    for (int64_t row = 0; row < size_[1] * size_[2]; ++row) {
      design::check_stop(stop);
      nearest_.insert(nearest_.end(), static_cast<size_t>(size_[0]), Place{none, none, none});
    }
    each_cell([&](const Cell& at, size_t n) { begin(at, n); });
  }

  // Sweeps twice in each of the eight directions.
  void run(const design::StageWork& work) {
    constexpr int rounds = 2, directions = 8;
    for (int n = 0; n < rounds * directions; ++n) {
      sweep((n & 1) != 0, (n & 2) != 0, (n & 4) != 0);
      work.tell(static_cast<double>(n + 1) / (rounds * directions));
    }
  }

  void write(std::vector<float>& distances) const {
    each_cell([&](const Cell& at, size_t n) {
      const auto distance = static_cast<float>(std::sqrt(squared_distance(place(at), nearest_[n])));
      distances[n] = values_[n] <= 0 ? -distance : distance;
    });
  }

 private:
  using Cell = std::array<int64_t, 3>;
  static constexpr float none = 1e18f;  // far from every point

  template <class Visit>
  void each_cell(const Visit& visit) const {
    size_t n = 0;
    for (int64_t k = 0; k < size_[2]; ++k)
      for (int64_t j = 0; j < size_[1]; ++j) {
        design::check_stop(stop_);
        for (int64_t i = 0; i < size_[0]; ++i, ++n) visit(Cell{i, j, k}, n);
      }
  }

  Place place(const Cell& at) const {
    Place place;
    for (size_t a = 0; a < 3; ++a)
      place[a] = static_cast<float>(static_cast<double>(at[a]) * cell_[static_cast<int>(a)]);
    return place;
  }

  static double squared_distance(const Place& a, const Place& b) {
    double sum = 0;
    for (size_t n = 0; n < 3; ++n) {
      const double d = static_cast<double>(a[n]) - static_cast<double>(b[n]);
      sum += d * d;
    }
    return sum;
  }

  // Next to the surface, the nearest point is that of the plane through the surface's intersections with lattice lines.
  void begin(const Cell& at, size_t n) {
    Vec3 slope;  // slope of the plane: 1 over the distance to the intersection along each axis
    for (size_t axis = 0; axis < 3; ++axis) {
      const double way = way_to_crossing(at, n, axis);
      if (way != 0) slope[static_cast<int>(axis)] = 1 / way;
    }
    const double squares = dot(slope, slope);
    if (squares == 0) return;
    Place found = place(at);
    for (size_t a = 0; a < 3; ++a) found[a] += static_cast<float>(slope[static_cast<int>(a)] / squares);
    nearest_[n] = found;
  }

  // Returns the signed distance to the intersection, or 0 if the neighbours are on the same side.
  double way_to_crossing(const Cell& at, size_t n, size_t axis) const {
    constexpr double least = 1e-6;  // least distance in cells, for a surface through the centre
    double nearest = 0;
    for (const int side : {-1, 1}) {
      const int64_t next = at[axis] + side;
      if (next < 0 || next >= size_[axis]) continue;
      const float other = values_[static_cast<size_t>(static_cast<int64_t>(n) + side * step_[axis])];
      if ((values_[n] <= 0) == (other <= 0)) continue;
      const double here = std::abs(static_cast<double>(values_[n])), there = std::abs(static_cast<double>(other));
      const double share = here + there > 0 ? here / (here + there) : 0.5;
      const double way = side * std::max(share, least) * cell_[static_cast<int>(axis)];
      if (nearest == 0 || std::abs(way) < std::abs(nearest)) nearest = way;
    }
    return nearest;
  }

  void sweep(bool back_x, bool back_y, bool back_z) {
    for (int64_t z = 0; z < size_[2]; ++z)
      for (int64_t y = 0; y < size_[1]; ++y) {
        design::check_stop(stop_);
        for (int64_t x = 0; x < size_[0]; ++x)
          update({back_x ? size_[0] - 1 - x : x, back_y ? size_[1] - 1 - y : y, back_z ? size_[2] - 1 - z : z});
      }
  }

  // Near the surface, neighbours across edges and corners are used, too, since one point per voxel is sparse there.
  void update(const Cell& at) {
    constexpr double near_cells = 3;
    constexpr size_t beside = 6;
    const auto n = static_cast<size_t>(at[0] + step_[1] * at[1] + step_[2] * at[2]);
    const Place here = place(at);
    double least = squared_distance(here, nearest_[n]);
    const double longest = std::max({cell_.x, cell_.y, cell_.z});
    const bool is_near = least < square(near_cells * longest) || least >= static_cast<double>(none);
    const std::span<const Cell> all(neighbours_);
    for (const Cell& way : is_near ? all : all.first(beside)) {
      const Cell next{at[0] + way[0], at[1] + way[1], at[2] + way[2]};
      if (!holds(next)) continue;
      const Place& other = nearest_[static_cast<size_t>(next[0] + step_[1] * next[1] + step_[2] * next[2])];
      const double distance = squared_distance(here, other);
      if (distance >= least) continue;
      least = distance;
      nearest_[n] = other;
    }
  }

  bool holds(const Cell& at) const {
    for (size_t a = 0; a < 3; ++a)
      if (at[a] < 0 || at[a] >= size_[a]) return false;
    return true;
  }

  static double square(double v) { return v * v; }

  // Neighbours across sides come first.
  static std::vector<Cell> make_neighbours() {
    std::vector<Cell> ways;
    for (const int64_t sides : {1, 2, 3})
      for (int64_t k = -1; k <= 1; ++k)
        for (int64_t j = -1; j <= 1; ++j)
          for (int64_t i = -1; i <= 1; ++i)
            if (i * i + j * j + k * k == sides) ways.push_back({i, j, k});
    return ways;
  }

  Vec3 cell_;
  const std::vector<float>& values_;
  const StopFlag* stop_;
  std::array<int64_t, 3> size_{}, step_{};
  std::vector<Place> nearest_;
  const std::vector<Cell> neighbours_ = make_neighbours();
};

class DistanceStage final : public design::WholeStage {
 public:
  DistanceStage(const design::NodePtr& solid, const std::optional<Vec3>& cell_mm, double margin_mm)
      : solid_(solid), cell_mm_(cell_mm), margin_mm_(margin_mm) {}

  std::string name() const override { return "redistance"; }
  Hash content() const override { return hash_bytes("redistance " + format_number(margin_mm_)); }
  Box bounds() const override {
    const Box box = solid_->bounds(design::design_space());
    return box.is_empty() ? box : box.expanded(margin_mm_);
  }
  design::LatticeChoice lattice() const override { return {cell_mm_, false}; }
  double bytes_of_cell() const override { return sizeof(Place); }
  std::vector<design::StageRead> reads() const override { return {{.solid = solid_, .distance = true}}; }
  std::vector<design::StageChannel> channels(const std::vector<design::StageChannel>&) const override {
    return {{"sdf", {}, 0, false}, {"known", {}, 0, true, {0, 1}}};
  }

  void compute(const StageValues& read, StageValues& made, const design::StageLattice& lattice,
               const design::StageWork& work) const override {
    Sweeping sweeping(read.channel(0), read.box(),
                      {lattice.pitch[0].mm(), lattice.pitch[1].mm(), lattice.pitch[2].mm()}, work.stop);
    sweeping.run(work);
    sweeping.write(made.channel(0));
    std::ranges::fill(made.channel(1), 1.0f);
  }

 private:
  design::NodePtr solid_;
  std::optional<Vec3> cell_mm_;
  double margin_mm_;
};

}  // namespace

design::StagePtr make_distance_stage(const design::NodePtr& solid, const std::optional<Vec3>& cell_mm,
                                     double margin_mm) {
  return std::make_shared<DistanceStage>(solid, cell_mm, margin_mm);
}

}  // namespace ombre::nodes
