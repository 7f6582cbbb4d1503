#include "jobs/printable/corrections.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "jobs/printable/flag_pieces.h"
#include "jobs/slice/channel_counts.h"

namespace ombre::compile {
namespace {

constexpr double volume_rounding = 1e-9;  // as a share

// Leaves out the largest of bodies that are all small, and of several the lowest: it is the part.
void spare_largest(std::vector<FlagPiece>& bodies) {
  if (!bodies.empty()) bodies.erase(std::ranges::max_element(bodies, {}, &FlagPiece::voxels));
}

// The balls of different sizes in voxels whose diameters are less than the limit, the largest first.
std::vector<Offsets> smaller_balls(double limit_mm, Vec3 voxel_mm) {
  std::set<double, std::greater<>> diameters;
  for (int axis = 0; axis < 3; ++axis)
    for (int n = 1; n * voxel_mm[axis] < limit_mm; ++n) diameters.insert(n * voxel_mm[axis]);
  std::vector<Offsets> balls;
  for (const double diameter : diameters) balls.push_back(ball_offsets(diameter, voxel_mm));
  balls.push_back(ball_offsets(std::min({voxel_mm.x, voxel_mm.y, voxel_mm.z, limit_mm}), voxel_mm));
  return balls;
}

struct VoxelOffset {
  int64_t i = 0, j = 0, k = 0;
};

// Returns offsets of at most this length, the shortest first; of several the lowest.
std::vector<VoxelOffset> offsets_by_length(double most_mm, Vec3 voxel_mm) {
  std::vector<std::pair<double, VoxelOffset>> found;
  for (const OffsetSpan& span : offsets_within(most_mm, voxel_mm).spans)
    for (int64_t i = span.from; i <= span.to; ++i) {
      const Vec3 apart{static_cast<double>(i) * voxel_mm.x, static_cast<double>(span.j) * voxel_mm.y,
                       static_cast<double>(span.k) * voxel_mm.z};
      found.push_back({length(apart), {i, span.j, span.k}});
    }
  std::ranges::stable_sort(found, {}, &std::pair<double, VoxelOffset>::first);
  std::vector<VoxelOffset> offsets;
  for (const auto& [mm, offset] : found) offsets.push_back(offset);
  return offsets;
}

MaterialId material_of(const RowView& row, int64_t i) {
  size_t dense = 0;
  int64_t begin = 0;
  for (const Run& run : row.runs) {
    if (i < begin + run.length) return run.is_dense ? row.dense[dense + static_cast<size_t>(i - begin)] : run.material;
    begin += run.length;
    if (run.is_dense) dense += run.length;
  }
  return 0;
}

bool is_empty(const BitLayers& region) {
  return std::ranges::all_of(region.layers, [](const BitLayer& layer) { return layer.count() == 0; });
}

void join(BitLayers& region, const BitLayers& other) {
  for (size_t n = 0; n < region.layers.size(); ++n) region.layers[n] |= other.layers[n];
}
void cut(BitLayers& region, const BitLayers& other) {
  for (size_t n = 0; n < region.layers.size(); ++n) region.layers[n].remove(other.layers[n]);
}

class Thickening {
 public:
  Thickening(double limit_mm, Vec3 voxel_mm)
      : limit_mm_(limit_mm),
        voxel_mm_(voxel_mm),
        ball_(ball_offsets(limit_mm, voxel_mm)),
        smaller_(smaller_balls(limit_mm, voxel_mm)),
        near_(offsets_by_length(limit_mm + length(voxel_mm), voxel_mm)) {}

  int64_t growth() const { return ball_.reach(); }
  int64_t reach() const {
    return 2 * ball_.reach() + std::max(2 * ball_.reach(), reach_of_thin_places(limit_mm_, voxel_mm_));
  }

  // Returns what is added to layers [begin, end) of a region.
  BitLayers added(const BitLayers& region, int64_t begin, int64_t end) const {
    const int64_t near = ball_.reach(), far = 2 * ball_.reach();
    BitLayers thin = thin_places(region, limit_mm_, voxel_mm_, begin - far, end + far);
    BitLayers middles{begin - near, {}};
    middles.layers.assign(static_cast<size_t>(end - begin + 2 * near), empty_like(region));
    for (size_t n = 0; n < smaller_.size() && !is_empty(thin); ++n) {
      const Offsets& ball = smaller_[n];
      const BitLayers fitting = eroded(region, ball, begin - far - near, end + far + near);
      // The middles of balls of this size that hold a thin voxel, which no larger ball holds.
      BitLayers holding = dilated(thin, ball.reflected(), begin - near, end + near);
      for (int64_t k = holding.first; k < holding.end(); ++k)
        holding.layers[static_cast<size_t>(k - holding.first)] &= fitting.at(k);
      join(middles, holding);
      cut(thin, dilated(fitting, ball, begin - far, end + far));
    }
    BitLayers grown = dilated(middles, ball_, begin, end);
    for (int64_t k = begin; k < end; ++k) grown.layers[static_cast<size_t>(k - begin)].remove(region.at(k));
    return grown;
  }

  // Returns the material of the nearest voxel of the solid.
  MaterialId material_near(const SolidLayers& layers, int64_t margin, int64_t i, int64_t j, int64_t k) const {
    for (const VoxelOffset& offset : near_) {
      const int64_t x = i + offset.i, y = j + offset.j, z = k + offset.k;
      if (z < layers.solid.first || z >= layers.solid.end()) continue;
      const BitLayer& layer = layers.solid.at(z);
      if (x < 0 || y < 0 || x >= layer.width() || y >= layer.height() || !layer.get(x, y)) continue;
      const auto& voxels = layers.voxels[static_cast<size_t>(z - layers.solid.first)];
      return material_of(voxels->row(static_cast<uint32_t>(y - margin)), x - margin);
    }
    return 0;
  }

 private:
  static BitLayer empty_like(const BitLayers& region) {
    return {region.layers.front().width(), region.layers.front().height()};
  }

  double limit_mm_ = 0;
  Vec3 voxel_mm_;
  Offsets ball_;
  std::vector<Offsets> smaller_;
  std::vector<VoxelOffset> near_;
};

// Adds the voxels of a row of flags, each with the material that is nearest to it.
void add_row(const Thickening& thickening, const SolidLayers& layers, const BitLayer& flags, int64_t margin, int64_t j,
             int64_t k, VoxelChanges& changes) {
  each_run(flags, j, [&](int64_t begin, int64_t end) {
    for (int64_t i = begin; i < end;) {
      const MaterialId material = thickening.material_near(layers, margin, i, j, k);
      int64_t next = i + 1;
      while (next < end && thickening.material_near(layers, margin, next, j, k) == material) ++next;
      changes.add(k, {j - margin, i - margin, next - margin, material});
      i = next;
    }
  });
}

}  // namespace

VoxelChanges drop_loose_bodies(const Plan& plan, double below_mm3, MaterialId support, const CheckRun& run) {
  const double limit = below_mm3 / voxel_mm3(plan.request.lattice) * (1 - volume_rounding);
  const uint64_t most_voxels = limit > 1 ? static_cast<uint64_t>(std::ceil(limit) - 1) : 0;
  std::vector<FlagPiece> bodies;
  bool has_large = false;
  const auto take = [&](const FlagPiece& body) {
    if (body.voxels <= most_voxels) bodies.push_back(body);
    has_large = has_large || body.voxels > most_voxels;
    return false;
  };
  FlagPieceFinder finder(take, most_voxels);
  WindowShape shape;
  if (support != 0) shape.materials = {support};
  each_window(plan, shape, run, [&](const SolidLayers& layers, int64_t begin, int64_t end) {
    const BitLayers solid = solid_without(layers, support, begin, end);
    for (int64_t k = begin; k < end; ++k) finder.add(k, solid.at(k));
  });
  finder.finish();
  if (!has_large) spare_largest(bodies);
  VoxelChanges changes;
  for (const FlagPiece& body : bodies)
    for (const FlagRun& at : body.runs)
      changes.add(at.k, {at.j - shape.margin(), at.begin - shape.margin(), at.end - shape.margin(), 0});
  return changes;
}

VoxelChanges thicken(const Plan& plan, double limit_mm, bool may_grow, const CheckRun& run) {
  const Thickening thickening(limit_mm, plan.request.lattice.voxel_mm());
  WindowShape shape;
  shape.reach = thickening.reach();
  shape.beyond = 1 + thickening.growth();
  shape.has_voxels = true;
  const auto& count = plan.request.lattice.count;
  VoxelChanges changes;
  each_window(plan, shape, run, [&](const SolidLayers& layers, int64_t begin, int64_t end) {
    const BitLayers added = thickening.added(layers.solid, begin, end);
    const int64_t margin = shape.margin();
    BitLayer allowed(added.layers.front().width(), added.layers.front().height());
    for (int64_t j = 0; j < allowed.height(); ++j)
      if (may_grow)
        allowed.set(j, 0, allowed.width());
      else if (j >= margin && j < margin + count[1])
        allowed.set(j, margin, margin + count[0]);
    for (int64_t k = begin; k < end; ++k) {
      if (!may_grow && (k < 0 || k >= count[2])) continue;
      BitLayer flags = added.at(k);
      flags &= allowed;
      for (int64_t j = 0; j < flags.height(); ++j) add_row(thickening, layers, flags, margin, j, k, changes);
    }
  });
  return changes;
}

VoxelChanges keep_apart(const Plan& plan, const std::vector<PrintCheck>& checks, MaterialId neutral,
                        const CheckRun& run) {
  WindowShape shape;
  std::vector<const PrintCheck*> rules;
  for (const PrintCheck& check : checks) {
    if (check.kind != "neighbour") continue;
    rules.push_back(&check);
    shape.reach = std::max(shape.reach, check.reach);
    shape.materials.insert(shape.materials.end(), check.materials.begin(), check.materials.end());
  }
  VoxelChanges changes;
  if (rules.empty()) return changes;
  each_window(plan, shape, run, [&](const SolidLayers& layers, int64_t begin, int64_t end) {
    BitLayers flags = rules.front()->flags(layers, begin, end);
    for (size_t n = 1; n < rules.size(); ++n) join(flags, rules[n]->flags(layers, begin, end));
    for (int64_t k = begin; k < end; ++k) changes.add(k, flags.at(k), shape.margin(), neutral);
  });
  return changes;
}

}  // namespace ombre::compile
