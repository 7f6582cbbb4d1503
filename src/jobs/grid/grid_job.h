// A design sampled on a part of its lattice: what voxel grids for other programs are made of.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "design/lowered.h"
#include "jobs/slice/plan.h"
#include "voxel/fields.h"

namespace ombre::compile {

// What a grid holds for each voxel.
enum class GridKind {
  material,   // its material's id: what slicing puts there
  fraction,   // of one material, before dithering; 0 outside
  distance,   // from its centre to the surface, mm, negative inside
  attribute,  // its value; the default outside
};

struct Grid {
  GridKind kind = GridKind::material;
  std::string name;                            // of an attribute's number, such as "fibre.x"
  std::optional<SliceMaterial> material = {};  // of a fraction
  design::AttributeDeclaration attribute = {};
};

// Which grids are wanted.
struct GridQuery {
  bool materials = false, fractions = false, distance = false;
  bool narrow_band = false;                  // distances beyond a few voxels are cut off
  std::vector<std::string> attributes = {};  // by name
  bool all_attributes = false;
};

// Distances in a narrow band reach so far to both sides of the surface.
constexpr double band_voxels = 3;

// Thread-safe. Values of all grids, in their order, and of the mark.
using TileProducer = std::function<std::vector<voxel::FieldTile>(const voxel::TileBox& region, const StopFlag* stop)>;

struct GridJob {
  Sampling request;       // the lattice, the materials and what else decides the values
  voxel::TileBox region;  // the voxels that are wanted
  std::vector<Grid> grids;
  double band_mm = 0;            // of distances; 0: they are not cut off
  design::Metric metric;         // what distances are
  bool has_inside_flag = false;  // behind the grids, tiles have 1 inside and 0 outside
  TileProducer tiles;
  JobStagesPtr stages;
  size_t memory_bytes = size_t{2} << 30;  // for slabs in flight and stages; one layer at a time is always allowed
};

// How much of a job is in flight at once.
struct GridWork {
  int64_t slab_layers = 8;
  size_t window = 1;        // slabs
  double memory_bytes = 0;  // the most that these slabs and stages can take, once stages are prepared
};
GridWork size_grid_work(const GridJob& job, int threads);

// Nothing, and diagnostics, when the design cannot be sampled, or has no such attribute.
std::optional<GridJob> plan_grids(const LoadedPtr& loaded, const Plan& plan, const GridQuery& query,
                                  const voxel::TileBox& region, Diagnostics& diagnostics);

// Calls `take` with all tiles of one slab of layers after the other, lowest first; `tiles` reach no further than
// `slab`. Slabs begin at multiples of 8 voxels. Throws Cancelled.
struct GridSlab {
  voxel::TileBox box;
  std::vector<voxel::FieldTile> tiles;
};
void each_slab(const GridJob& job, int threads, const std::function<void(const GridSlab&)>& take, Progress* progress,
               const StopFlag* stop);

// Whether some voxel of the tile is inside the design.
bool has_inside(const GridJob& job, const voxel::FieldTile& tile);

}  // namespace ombre::compile
