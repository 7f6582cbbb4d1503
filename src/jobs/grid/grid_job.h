// Samples a design on a part of its lattice, for voxel grids of other programs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "design/lowered.h"
#include "jobs/slice/plan.h"
#include "voxel/fields.h"

namespace ombre::compile {

// The numbers of a grid.
enum class GridKind {
  material,   // id of the material that slicing puts there
  fraction,   // fraction of one material before dithering; 0 outside
  distance,   // distance from the voxel's centre to the surface, mm, negative inside
  attribute,  // value of the attribute; the default outside
};

struct Grid {
  GridKind kind = GridKind::material;
  std::string name;                            // name of an attribute's number, such as "fibre.x"
  std::optional<SliceMaterial> material = {};  // only for a fraction
  design::AttributeDeclaration attribute = {};
};

// The grids that are requested.
struct GridQuery {
  bool materials = false, fractions = false, distance = false;
  bool narrow_band = false;                  // distances are limited to a few voxels
  std::vector<std::string> attributes = {};  // names of attributes
  bool all_attributes = false;
};

// Half the width of a narrow band, in voxels.
constexpr double band_voxels = 3;

// A thread-safe function that returns the values of all grids, in their order, and of the flag.
using TileProducer = std::function<std::vector<voxel::FieldTile>(const voxel::TileBox& region, const StopFlag* stop)>;

struct GridJob {
  Sampling request;       // the lattice, the materials and all else that decides the values
  voxel::TileBox region;  // the voxels that are requested
  std::vector<Grid> grids;
  double band_mm = 0;            // limit of distances; 0: none
  design::Metric metric;         // the meaning of distances
  bool has_inside_flag = false;  // after the grids, tiles have 1 inside and 0 outside
  TileProducer tiles;
  JobStagesPtr stages;
  size_t memory_bytes = size_t{2} << 30;  // for slabs in flight and stages; one layer at a time is always allowed
};

// The part of a job that is in flight at once.
struct GridWork {
  int64_t slab_layers = 8;
  size_t window = 1;        // slabs
  double memory_bytes = 0;  // the most that these slabs and stages can take, once stages are prepared
};
GridWork size_grid_work(const GridJob& job, int threads);
// Returns the layers of the largest slabs: 8, or fewer where layers are large.
int64_t most_slab_layers(const GridJob& job);

// Plans grids. Returns nothing, and adds diagnostics, when the design cannot be sampled, or lacks an attribute.
std::optional<GridJob> plan_grids(const LoadedPtr& loaded, const Plan& plan, const GridQuery& query,
                                  const voxel::TileBox& region, Diagnostics& diagnostics);

// A slab of layers with its tiles, which `take` below gets one after the other, lowest first; `tiles` reach no further
// than `slab`. Slabs begin at multiples of 8 voxels. Throws Cancelled.
struct GridSlab {
  voxel::TileBox box;
  std::vector<voxel::FieldTile> tiles;
};
void each_slab(const GridJob& job, int threads, const std::function<void(const GridSlab&)>& take, Progress* progress,
               const StopFlag* stop);

// True if some voxel of the tile is inside the design.
bool has_inside(const GridJob& job, const voxel::FieldTile& tile);

}  // namespace ombre::compile
