// Finds parts and gaps of a design that are too thin to contain a corner of the cells.
#include "surface/mesh/lost_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "surface/cells/point_evaluator.h"
#include "surface/cells/shortened.h"
#include "voxel/fields.h"
#include "voxel/layers.h"

namespace ombre::surface {
namespace {

using voxel::FieldTile;
using voxel::Lattice;
using voxel::TileBox;

constexpr double most_cells = 1 << 29;
constexpr int64_t check_layers = 8, check_rows = 256;
// Lengths in cells: greatest distance from a corner to a border, margin around facets, distance behind a border at
// which a part is looked for, and step of finite differences.
constexpr double border_reach = 0.75, facet_room = 1, step_behind = 0.002, difference_step = 0.001;

// Flags the cells near facets.
class NearFacets {
 public:
  NearFacets(const RegionSurface& surface, const Lattice& corners) : corners_(corners) {
    size_t cells = 1;
    for (size_t axis = 0; axis < 3; ++axis) {
      size_mm_[static_cast<int>(axis)] = corners.pitch[axis].mm();
      count_[axis] = std::max<int64_t>(corners.count[axis] - 1, 1);
      cells *= static_cast<size_t>(count_[axis]);
    }
    near_.resize(cells);
    for (const Facet& facet : surface.facets)
      flag(
          {surface.vertices[facet.corners[0]], surface.vertices[facet.corners[1]], surface.vertices[facet.corners[2]]});
  }

  bool around(const std::array<int64_t, 3>& corner) const {
    for (int64_t z = corner[2] - 1; z <= corner[2]; ++z)
      for (int64_t y = corner[1] - 1; y <= corner[1]; ++y)
        for (int64_t x = corner[0] - 1; x <= corner[0]; ++x)
          if (x < 0 || y < 0 || z < 0 || x >= count_[0] || y >= count_[1] || z >= count_[2] || near_[number(x, y, z)])
            return true;
    return false;
  }

 private:
  size_t number(int64_t x, int64_t y, int64_t z) const {
    return static_cast<size_t>((z * count_[1] + y) * count_[0] + x);
  }

  int64_t cell_at(double mm, size_t axis) const {
    const double cell = std::floor((mm - corners_.center(axis, 0)) / size_mm_[static_cast<int>(axis)]);
    return static_cast<int64_t>(std::clamp(cell, 0.0, static_cast<double>(count_[axis] - 1)));
  }

  // Flags the cells around the triangle that its plane passes near.
  void flag(const std::array<Vec3, 3>& t) {
    const Vec3 room = facet_room * size_mm_, normal = cross(t[1] - t[0], t[2] - t[0]);
    std::array<int64_t, 3> lo, hi;
    for (size_t a = 0; a < 3; ++a) {
      const int axis = static_cast<int>(a);
      lo[a] = cell_at(std::min({t[0][axis], t[1][axis], t[2][axis]}) - room[axis], a);
      hi[a] = cell_at(std::max({t[0][axis], t[1][axis], t[2][axis]}) + room[axis], a);
    }
    const double far = std::abs(normal.x) * (0.5 * size_mm_.x + room.x) +
                       std::abs(normal.y) * (0.5 * size_mm_.y + room.y) +
                       std::abs(normal.z) * (0.5 * size_mm_.z + room.z);
    for (int64_t z = lo[2]; z <= hi[2]; ++z)
      for (int64_t y = lo[1]; y <= hi[1]; ++y)
        for (int64_t x = lo[0]; x <= hi[0]; ++x)
          if (std::abs(dot(normal, corners_.center(x, y, z) + 0.5 * size_mm_ - t[0])) <= far)
            near_[number(x, y, z)] = true;
  }

  const Lattice& corners_;
  Vec3 size_mm_;
  std::array<int64_t, 3> count_{};
  std::vector<bool> near_;
};

// Searches for lost parts from the corners of a tile.
class CornerCheck {
 public:
  CornerCheck(const Partition& partition, const Lattice& corners, const NearFacets& facets)
      : partition_(partition), corners_(corners), facets_(facets) {
    cell_mm_ = std::min({corners.pitch[0].mm(), corners.pitch[1].mm(), corners.pitch[2].mm()});
  }

  void check(const FieldTile& tile, LostParts& lost) {
    std::vector<Vec3> points;
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j)
        for (int64_t i = tile.box.lo[0]; i < tile.box.hi[0]; ++i)
          if (!facets_.around({i, j, k})) points.push_back(corners_.center(i, j, k));
    if (points.empty()) return;
    Box box;
    for (const Vec3& p : points) box = hull(box, {p, p});
    box = box.expanded(2 * cell_mm_);
    program_ = shortened_for(partition_.details.around(box), box);
    asker_.begin(partition_, program_);
    asker_.ask(points);
    std::vector<size_t> close;
    for (size_t n = 0; n < points.size(); ++n)
      if (std::abs(distance(n)) < border_reach * cell_mm_) close.push_back(n);
    for (const size_t n : close) check_from(points[n], lost);
  }

 private:
  double distance(size_t n) const { return asker_.between(1, 0, n); }

  void check_from(Vec3 p, LostParts& lost) {
    const double step = difference_step * cell_mm_;
    asker_.ask({p, p + Vec3{step, 0, 0}, p - Vec3{step, 0, 0}, p + Vec3{0, step, 0}, p - Vec3{0, step, 0},
                p + Vec3{0, 0, step}, p - Vec3{0, 0, step}});
    const bool is_void = asker_.label(0) == 0;
    const double here = distance(0);
    const Vec3 slope =
        (0.5 / step) * Vec3{distance(1) - distance(2), distance(3) - distance(4), distance(5) - distance(6)};
    const double squared = dot(slope, slope);
    if (!(squared > 0) || !std::isfinite(squared)) return;
    // Finds the border with two Newton steps, then goes slightly beyond it.
    Vec3 border = p - (here / squared) * slope;
    asker_.ask({border});
    border = border - (distance(0) / squared) * slope;
    const Vec3 past = border - (std::copysign(step_behind * cell_mm_, here) / std::sqrt(squared)) * slope;
    asker_.ask({past});
    if (length(past - p) > cell_mm_ || (asker_.label(0) == 0) == is_void) return;
    if (lost.places++ == 0) lost.first = border;
  }

  const Partition& partition_;
  const Lattice& corners_;
  const NearFacets& facets_;
  double cell_mm_;
  program::Program program_;
  PointEvaluator asker_;
};

}  // namespace

LostParts find_lost_parts(const Partition& partition, const RegionSurface& surface, const Lattice& corners, int threads,
                          const StopFlag* stop) {
  LostParts lost;
  if (static_cast<double>(corners.count[0]) * static_cast<double>(corners.count[1]) *
          static_cast<double>(corners.count[2]) >
      most_cells)
    return lost;
  const NearFacets facets(surface, corners);
  const voxel::FieldEvaluator evaluator(partition.label, corners, voxel::best_evaluator(corners));
  const auto slabs = static_cast<size_t>((corners.count[2] + check_layers - 1) / check_layers);
  run_ordered<LostParts>(
      slabs, threads, 2 * static_cast<size_t>(threads > 0 ? threads : core_count()),
      [&](size_t n) {
        LostParts found;
        CornerCheck check(partition, corners, facets);
        TileBox strip{{0, 0, static_cast<int64_t>(n) * check_layers}, corners.count};
        strip.hi[2] = std::min(strip.lo[2] + check_layers, corners.count[2]);
        for (; strip.lo[1] < corners.count[1]; strip.lo[1] += check_rows) {
          strip.hi[1] = std::min(strip.lo[1] + check_rows, corners.count[1]);
          for (const FieldTile& tile : evaluator.tiles(strip, stop))
            if (!tile.is_uniform && !(stop && stop->requested())) check.check(tile, found);
        }
        return found;
      },
      [&](size_t, const LostParts& found) {
        if (stop && stop->requested()) throw Cancelled();
        if (lost.places == 0) lost.first = found.first;
        lost.places += found.places;
      });
  return lost;
}

}  // namespace ombre::surface
