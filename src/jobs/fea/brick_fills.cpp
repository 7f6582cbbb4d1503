#include "jobs/fea/brick_fills.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "jobs/grid/grid_job.h"
#include "questions/sampler.h"

namespace ombre::compile {
namespace {

using fea::Cell;
using fea::Fill;
using fea::parts_along;

constexpr auto along = static_cast<int64_t>(parts_along);

Fill bit_of(size_t x, size_t y, size_t z) { return Fill{1} << (x + parts_along * (y + parts_along * z)); }

// Returns four times the squared distance from the centre, in parts.
int64_t off_centre(size_t x, size_t y, size_t z) {
  const auto square = [](size_t n) {
    const int64_t off = 2 * static_cast<int64_t>(n) + 1 - along;
    return off * off;
  };
  return square(x) + square(y) + square(z);
}

// Returns the place of a part's point in its brick, from 0 to 1 along each axis. No two of the 64 points share a
// coordinate.
Vec3 point_of(size_t x, size_t y, size_t z) {
  const auto within = [](size_t part, size_t a, size_t b) {
    constexpr size_t columns = parts_along * parts_along, stride = 7;
    const double offset = (static_cast<double>((parts_along * a + b) * stride % columns) + 0.5) / columns;
    return (static_cast<double>(part) + offset) / parts_along;
  };
  return {within(x, y, z), within(y, z, x), within(z, x, y)};
}

template <class Body>
void each_part(const Body& body) {
  for (size_t z = 0; z < parts_along; ++z)
    for (size_t y = 0; y < parts_along; ++y)
      for (size_t x = 0; x < parts_along; ++x) body(x, y, z);
}

// Gathers layers of bricks from a grid of their parts, which comes slab by slab.
class Gatherer {
 public:
  explicit Gatherer(const voxel::Lattice& parts) : nx_(parts.count[0] / along), ny_(parts.count[1] / along) {}

  void take(const GridSlab& slab) {
    const int64_t first = slab.box.lo[2] / along, layers = (slab.box.size(2) + along - 1) / along;
    bricks_.assign(static_cast<size_t>(nx_ * ny_ * layers), {});
    for (const voxel::FieldTile& tile : slab.tiles) take(tile, first);
    for (size_t n = 0; n < bricks_.size(); ++n) {
      if (bricks_[n].fill == 0) continue;
      const auto at = static_cast<int64_t>(n);
      found_.push_back({{static_cast<int32_t>(at % nx_), static_cast<int32_t>(at / nx_ % ny_),
                         static_cast<int32_t>(first + at / (nx_ * ny_))},
                        bricks_[n].fill,
                        bricks_[n].drawn,
                        {}});
    }
  }

  std::vector<FilledBrick> found() { return std::move(found_); }

 private:
  struct Gathered {
    Fill fill = 0;
    MaterialId drawn = 0;
    int64_t off = 0;  // distance from the centre of the part that was drawn
  };

  void take(const voxel::FieldTile& tile, int64_t first) {
    const float* from = tile.output(0);
    if (tile.is_uniform && *from == 0) return;
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j)
        for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i) {
          if (*from != 0) add({i, j, k}, first, static_cast<MaterialId>(*from));
          if (!tile.is_uniform) ++from;
        }
  }

  void add(const std::array<int64_t, 3>& part, int64_t first, MaterialId drawn) {
    const int64_t brick = ((part[2] / along - first) * ny_ + part[1] / along) * nx_ + part[0] / along;
    Gathered& here = bricks_[static_cast<size_t>(brick)];
    const auto x = static_cast<size_t>(part[0] % along), y = static_cast<size_t>(part[1] % along),
               z = static_cast<size_t>(part[2] % along);
    const Fill bit = bit_of(x, y, z);
    // Takes the nearest part, and of equally near ones that with the lowest bit, in whatever order they come.
    const int64_t off = off_centre(x, y, z) * static_cast<int64_t>(fea::parts_of_brick) + std::countr_zero(bit);
    if (here.fill == 0 || off < here.off) {
      here.off = off;
      here.drawn = drawn;
    }
    here.fill |= bit;
  }

  int64_t nx_, ny_;
  std::vector<Gathered> bricks_;
  std::vector<FilledBrick> found_;
};

// Samples bricks that the surface may cut more finely.
class Refiner {
 public:
  Refiner(const voxel::Lattice& parts, std::vector<FilledBrick> bricks)
      : parts_(parts), bricks_(std::move(bricks)), found_(bricks_) {}

  FilledBricks run(const Sampler& inside, int threads, const StopFlag* stop) {
    add_near_surface();
    constexpr size_t bricks_at_once = size_t{1} << 13;
    for (size_t begin = 0; begin < near_.size(); begin += bricks_at_once)
      sample(begin, std::min(near_.size(), begin + bricks_at_once), inside, threads, stop);
    std::ranges::sort(found_,
                      [](const FilledBrick& a, const FilledBrick& b) { return fea::is_before(a.cell, b.cell); });
    FilledBricks filled;
    for (const FilledBrick& brick : found_) filled.filled_count += fea::fill_share(brick.fill);
    std::erase_if(found_, [](const FilledBrick& brick) { return fea::fill_share(brick.fill) < fea::least_fill; });
    filled.bricks = std::move(found_);
    return filled;
  }

 private:
  const FilledBrick* find(const Cell& cell) const {
    const auto place = std::ranges::lower_bound(bricks_, cell, fea::is_before, &FilledBrick::cell);
    return place != bricks_.end() && place->cell == cell ? &*place : nullptr;
  }

  bool is_on_lattice(const Cell& cell) const {
    for (size_t axis = 0; axis < 3; ++axis)
      if (cell[axis] < 0 || cell[axis] >= parts_.count[axis] / along) return false;
    return true;
  }

  // Adds bricks that are cut, and those on both sides of a border between full, cut and empty ones.
  void add_near_surface() {
    std::vector<FilledBrick> empty;
    for (size_t n = 0; n < bricks_.size(); ++n) {
      bool is_near = bricks_[n].fill != fea::full_fill;
      for (size_t axis = 0; axis < 3; ++axis)
        for (const int32_t step : {-1, 1}) {
          Cell beside = bricks_[n].cell;
          beside[axis] += step;
          const FilledBrick* const other = find(beside);
          is_near = is_near || !other || other->fill != fea::full_fill;
          if (!other && is_on_lattice(beside)) empty.push_back({beside, 0, bricks_[n].drawn, {}});
        }
      if (is_near) near_.push_back(n);
    }
    const auto by_cell = [](const FilledBrick& a, const FilledBrick& b) { return fea::is_before(a.cell, b.cell); };
    std::ranges::stable_sort(empty, by_cell);
    const auto same = [](const FilledBrick& a, const FilledBrick& b) { return a.cell == b.cell; };
    empty.erase(std::unique(empty.begin(), empty.end(), same), empty.end());
    for (FilledBrick& brick : empty) {
      near_.push_back(found_.size());
      found_.push_back(brick);
    }
  }

  Vec3 place(const Cell& cell, Vec3 within) const {
    Vec3 p;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto at = static_cast<int>(axis);
      p[at] = parts_.origin[at] + parts_.pitch[axis].times(static_cast<double>(along) * (cell[axis] + within[at]));
    }
    return p;
  }

  void sample(size_t begin, size_t end, const Sampler& inside, int threads, const StopFlag* stop) {
    std::vector<Vec3> points;
    for (size_t n = begin; n < end; ++n)
      each_part(
          [&](size_t x, size_t y, size_t z) { points.push_back(place(found_[near_[n]].cell, point_of(x, y, z))); });
    std::vector<double> values(points.size());
    inside.sample(points, std::array{values.data()}, threads, stop);
    size_t next = 0;
    for (size_t n = begin; n < end; ++n) {
      Fill fill = 0;
      each_part([&](size_t x, size_t y, size_t z) {
        if (values[next++] > 0) fill |= bit_of(x, y, z);
      });
      FilledBrick& brick = found_[near_[n]];
      brick.fill = fill;
      if (fill != 0) brick.place = place_inside(brick);
    }
  }

  // Returns the point inside that is nearest to the centroid of all points inside.
  Vec3 place_inside(const FilledBrick& brick) const {
    const Vec3 middle = fea::fill_centre(brick.fill);
    Vec3 best;
    double least = 4;  // greater than the diagonal of a brick
    each_part([&](size_t x, size_t y, size_t z) {
      if (!fea::has_part(brick.fill, x, y, z)) return;
      const double off = length(point_of(x, y, z) - middle);
      if (off >= least) return;
      least = off;
      best = point_of(x, y, z);
    });
    return place(brick.cell, best);
  }

  const voxel::Lattice& parts_;
  std::vector<FilledBrick> bricks_;  // bricks by the lattice of parts
  std::vector<FilledBrick> found_;   // these bricks, and empty ones beside them
  std::vector<size_t> near_;         // indices in found_
};

}  // namespace

std::optional<Plan> plan_parts(const LoadedPtr& loaded, PlanOptions options, const voxel::Lattice& bricks,
                               Diagnostics& diagnostics) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto part = Pitch::from_ratio(bricks.pitch[axis].numerator, bricks.pitch[axis].denominator * along);
    options.pitch[axis] = part ? *part : *Pitch::from_mm(bricks.pitch[axis].mm() / static_cast<double>(along));
  }
  Diagnostics again;  // the plan of the bricks gave the same warnings
  auto plan = plan_over(loaded, bricks.box(), options, again);
  if (!plan) diagnostics.add_all(again);
  return plan;
}

std::optional<FilledBricks> fill_bricks(const design::Design& design, const LoadedPtr& loaded, const Plan& parts,
                                        int threads, Diagnostics& diagnostics, const StopFlag* stop) {
  GridQuery query;
  query.materials = true;
  const voxel::Lattice& lattice = parts.request.lattice;
  const auto job = plan_grids(loaded, parts, query, {{0, 0, 0}, lattice.count}, diagnostics);
  SampleQuery inside;
  inside.inside = true;
  const auto sampler = Sampler::build(design, inside, diagnostics);
  if (!job || !sampler) return std::nullopt;
  Gatherer gatherer(lattice);
  each_slab(
      *job, threads, [&](const GridSlab& slab) { gatherer.take(slab); }, nullptr, stop);
  return Refiner(lattice, gatherer.found()).run(*sampler, threads, stop);
}

}  // namespace ombre::compile
