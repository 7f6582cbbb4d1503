// Samples a design on a part of its lattice, for voxel grids of other programs.
#include "jobs/grid/grid_job.h"

#include <algorithm>

#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "jobs/slice/layer.h"
#include "questions/build.h"
#include "questions/field_program.h"
#include "questions/question.h"

namespace ombre::compile {
namespace {

using voxel::FieldTile;
using voxel::TileBox;

// Adds each stretch of a row as a tile.
void add_row(const RowView& row, std::array<int64_t, 3> at, std::vector<FieldTile>& tiles) {
  const MaterialId* dense = row.dense.data();
  for (const Run& run : row.runs) {
    const TileBox box{at, {at[0] + run.length, at[1] + 1, at[2] + 1}};
    if (run.is_dense)
      tiles.push_back({box, false, std::vector<float>(dense, dense + run.length)});
    else
      tiles.push_back({box, true, {static_cast<float>(run.material)}});
    if (run.is_dense) dense += run.length;
    at[0] += run.length;
  }
}

// Returns a producer of the materials that slicing puts into the voxels, run by run.
TileProducer material_tiles(const RegionProducer& regions) {
  return [regions](const TileBox& region, const StopFlag* stop) {
    std::vector<FieldTile> tiles;
    const auto made = regions(region, stop);
    for (int64_t k = region.lo[2]; k < region.hi[2]; ++k)
      for (int64_t j = region.lo[1]; j < region.hi[1]; ++j) {
        const RunLayer& layer = made[static_cast<size_t>(k - region.lo[2])].materials();
        add_row(layer.row(static_cast<uint32_t>(j - region.lo[1])), {region.lo[0], j, k}, tiles);
      }
    return tiles;
  };
}

// Returns the materials of a region's voxels, one after the other.
std::vector<float> dense_materials(const TileProducer& materials, const TileBox& region, const StopFlag* stop) {
  std::vector<float> dense(static_cast<size_t>(region.voxels()));
  for (const FieldTile& tile : materials(region, stop)) {
    const float* from = tile.output(0);
    const TileBox& box = tile.box;
    for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
      for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        float* to = dense.data() + ((k - region.lo[2]) * region.size(1) + (j - region.lo[1])) * region.size(0) +
                    (box.lo[0] - region.lo[0]);
        for (int64_t i = 0; i < box.size(0); ++i, from += tile.is_uniform ? 0 : 1) *to++ = *from;
      }
  }
  return dense;
}

// Returns a tile of fields with the materials of its voxels before them.
FieldTile joined_tile(const FieldTile& fields, const std::vector<float>& materials, const TileBox& region) {
  const TileBox& box = fields.box;
  const auto voxels = static_cast<size_t>(box.voxels());
  FieldTile joined{box, false, {}};
  for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
    for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
      const auto row = materials.begin() + ((k - region.lo[2]) * region.size(1) + (j - region.lo[1])) * region.size(0) +
                       (box.lo[0] - region.lo[0]);
      joined.values.insert(joined.values.end(), row, row + box.size(0));
    }
  if (!fields.is_uniform) joined.values.insert(joined.values.end(), fields.values.begin(), fields.values.end());
  for (size_t n = 0; fields.is_uniform && n < fields.values.size(); ++n)
    joined.values.insert(joined.values.end(), voxels, fields.values[n]);
  return joined;
}

TileProducer with_materials(const TileProducer& materials, const TileProducer& fields) {
  return [materials, fields](const TileBox& region, const StopFlag* stop) {
    const std::vector<float> dense = dense_materials(materials, region, stop);
    std::vector<FieldTile> tiles;
    for (const FieldTile& tile : fields(region, stop)) tiles.push_back(joined_tile(tile, dense, region));
    return tiles;
  };
}

// Grows the region of a whole design by the outer half of its band, where nothing is inside. A part that is cut out by
// a box is not grown.
TileBox with_band(const TileBox& region, const voxel::Lattice& lattice, const design::Design& design) {
  if (design.sampling || region.lo != std::array<int64_t, 3>{} || region.hi != lattice.count) return region;
  const auto more = static_cast<int64_t>(band_voxels) + 1;
  TileBox wider = region;
  for (size_t axis = 0; axis < 3; ++axis) {
    wider.lo[axis] -= more;
    wider.hi[axis] += more;
  }
  return wider;
}

std::optional<TileProducer> field_tiles(const LoadedPtr& loaded, const GridJob& job, Diagnostics& diagnostics) {
  FieldQuery query;
  for (const Grid& grid : job.grids) {
    if (grid.material) query.fractions.push_back(grid.material->id);
    query.distance |= grid.kind == GridKind::distance;
    if (grid.kind == GridKind::attribute) query.attributes.push_back(grid.name);
  }
  query.inside = job.has_inside_flag;
  if (job.band_mm > 0) query.band_mm = job.band_mm;
  const voxel::Lattice& lattice = job.request.lattice;
  design::Design design = design::for_lattice(loaded->design, {lattice.origin, lattice.pitch});
  design.stages = job.stages;
  auto program = build_field_program(design, query, diagnostics);
  if (!program) return std::nullopt;
  auto evaluator = std::make_shared<const voxel::FieldEvaluator>(std::move(*program), lattice, job.request.evaluator);
  return [loaded, evaluator](const TileBox& region, const StopFlag* stop) { return evaluator->tiles(region, stop); };
}

// Adds a grid for each number of the attribute, or for the named one.
void add_numbers(const design::AttributeDeclaration& attribute, const std::string& name, std::vector<Grid>& grids) {
  for (const std::string& part : design::parts_of(attribute))
    if (name == attribute.name || name == part) grids.push_back({GridKind::attribute, part, {}, attribute});
}

// Returns nothing, and adds a diagnostic, when the design has no such attribute.
std::optional<std::vector<Grid>> attribute_grids(const design::Design& design, const GridQuery& query,
                                                 Diagnostics& diagnostics) {
  const std::vector<design::AttributeDeclaration> known = declared_attributes(design);
  std::vector<Grid> grids;
  if (query.all_attributes && known.empty()) {
    diagnostics.error(Code::unknown_attribute, design.parts[0].solid->where(), "the design has no attributes",
                      "give it one, for example " + spelled::call("attribute", {{"", "\"density\""}, {"", "0.4"}}));
    return std::nullopt;
  }
  if (query.all_attributes)
    for (const auto& attribute : known) add_numbers(attribute, attribute.name, grids);
  for (const std::string& name : query.attributes) {
    const auto found = std::ranges::find(known, design::attribute_of_part(name), &design::AttributeDeclaration::name);
    const size_t before = grids.size();
    if (found != known.end()) add_numbers(*found, name, grids);
    if (grids.size() == before) {
      report_unknown_attribute(design, name, diagnostics);
      return std::nullopt;
    }
    if (query.all_attributes) grids.resize(before);
  }
  return grids;
}

std::vector<Grid> requested_grids(const Sampling& request, const GridQuery& query) {
  std::vector<Grid> grids;
  if (query.materials) grids.push_back({GridKind::material, "material", std::nullopt});
  if (query.distance) grids.push_back({GridKind::distance, "distance", std::nullopt});
  if (query.fractions)
    for (const SliceMaterial& material : request.materials)
      grids.push_back({GridKind::fraction, material.name, material});
  return grids;
}

double largest_pitch_mm(const voxel::Lattice& lattice) {
  return std::max({lattice.pitch[0].mm(), lattice.pitch[1].mm(), lattice.pitch[2].mm()});
}

constexpr int64_t slab_unit = 8;  // layers
constexpr double slab_bytes = 64 << 20, window_bytes = 1 << 30;

// Returns the bytes of a layer of all grids, as it is computed.
double layer_bytes(const GridJob& job) {
  return static_cast<double>(job.region.size(0) * job.region.size(1)) * static_cast<double>(job.grids.size()) *
         sizeof(float);
}

std::vector<TileBox> slabs_of(const GridJob& job, int64_t layers) {
  std::vector<TileBox> slabs;
  for (int64_t k = job.region.lo[2]; k < job.region.hi[2];) {
    TileBox slab = job.region;
    slab.lo[2] = k;
    slab.hi[2] = k = std::min(voxel::multiple_below(k, layers) + layers, job.region.hi[2]);
    slabs.push_back(slab);
  }
  return slabs;
}

}  // namespace

std::optional<GridJob> plan_grids(const LoadedPtr& loaded, const Plan& plan, const GridQuery& query,
                                  const TileBox& region, Diagnostics& diagnostics) {
  GridJob job;
  job.request = plan.request;
  job.stages = plan.stages;
  job.region = region;
  job.grids = requested_grids(plan.request, query);
  const auto attributes = attribute_grids(loaded->design, query, diagnostics);
  if (!attributes) return std::nullopt;
  // Values of attributes do not show what is inside, so a flag is added.
  job.has_inside_flag = job.grids.empty();
  job.grids.insert(job.grids.end(), attributes->begin(), attributes->end());
  job.metric = whole_solid(loaded->design)->metric();
  if (query.materials && job.grids.size() == 1) {
    job.has_inside_flag = false;
    job.tiles = material_tiles(plan.regions);
    return job;
  }
  if (query.narrow_band && query.distance && !query.materials) {
    job.band_mm = band_voxels * largest_pitch_mm(plan.request.lattice);
    job.region = with_band(region, plan.request.lattice, loaded->design);
  }
  auto tiles = field_tiles(loaded, job, diagnostics);
  if (!tiles) return std::nullopt;
  job.tiles = query.materials ? with_materials(material_tiles(plan.regions), *tiles) : std::move(*tiles);
  return job;
}

int64_t most_slab_layers(const GridJob& job) {
  int64_t layers = slab_unit;
  while (layers > 1 && layer_bytes(job) * static_cast<double>(layers) > slab_bytes) layers /= 2;
  return layers;
}

GridWork size_grid_work(const GridJob& job, int threads) {
  const auto stages = static_cast<double>(job.stages->memory_bytes({threads, job.memory_bytes, nullptr, nullptr}));
  const double allowed = std::min(window_bytes, static_cast<double>(job.memory_bytes) - stages);
  const double layer = layer_bytes(job);
  GridWork work{most_slab_layers(job)};
  // A file takes a copy of a slab.
  const auto slabs_in = [&](double bytes) { return bytes / (layer * static_cast<double>(work.slab_layers)) - 1; };
  while (work.slab_layers > 1 && slabs_in(allowed) < 1) work.slab_layers /= 2;
  const size_t wanted = 2 * static_cast<size_t>(threads > 0 ? threads : core_count());
  work.window = static_cast<size_t>(std::clamp(slabs_in(allowed), 1.0, static_cast<double>(wanted)));
  work.memory_bytes = stages + layer * static_cast<double>(work.slab_layers) * static_cast<double>(work.window + 1);
  return work;
}

void each_slab(const GridJob& job, int threads, const std::function<void(const GridSlab&)>& take, Progress* progress,
               const StopFlag* stop) {
  job.stages->prepare({threads, job.memory_bytes, progress, stop});
  const GridWork work = size_grid_work(job, threads);
  const std::vector<TileBox> slabs = slabs_of(job, work.slab_layers);
  const auto total = static_cast<uint64_t>(job.region.voxels());
  const Stopwatch watch;
  uint64_t done = 0;
  if (progress) progress->update(at_steady_pace(0, total, 0));
  run_ordered<GridSlab>(
      slabs.size(), threads, work.window,
      [&](size_t n) {
        return GridSlab{slabs[n], job.tiles(slabs[n], stop)};
      },
      [&](size_t, GridSlab& slab) {
        if (stop && stop->requested()) throw Cancelled();
        take(slab);
        done += static_cast<uint64_t>(slab.box.voxels());
        if (progress) progress->update(at_steady_pace(done, total, watch.seconds()));
      });
}

bool has_inside(const GridJob& job, const FieldTile& tile) {
  const size_t count = tile.is_uniform ? 1 : static_cast<size_t>(tile.box.voxels());
  const auto any = [&](size_t output, const auto& is_inside) {
    const float* values = tile.output(output);
    return std::any_of(values, values + count, is_inside);
  };
  if (job.has_inside_flag) return any(job.grids.size(), [](float v) { return v > 0; });
  for (size_t n = 0; n < job.grids.size(); ++n) {
    const GridKind kind = job.grids[n].kind;
    if (kind == GridKind::distance && any(n, [](float v) { return v <= 0; })) return true;
    if ((kind == GridKind::fraction || kind == GridKind::material) && any(n, [](float v) { return v > 0; }))
      return true;
  }
  return false;
}

}  // namespace ombre::compile
