#include "jobs/grid/vti_files.h"

#include <cstring>

#include "base/system/stopwatch.h"
#include "export/vti_file.h"

namespace ombre::compile {
namespace {

using voxel::FieldTile;
using voxel::TileBox;

// An array of the file, and the job's grids that are its components.
struct ArrayGrids {
  formats::VtiArray array;
  size_t first = 0, count = 1;
};

std::string component_of(const Grid& grid) {
  const size_t dot = grid.name.find('.');
  return grid.kind == GridKind::attribute && dot != std::string::npos ? grid.name.substr(dot + 1) : "";
}

std::vector<ArrayGrids> arrays_of(const std::vector<Grid>& grids) {
  std::vector<ArrayGrids> arrays;
  for (size_t n = 0; n < grids.size(); ++n) {
    const std::string component = component_of(grids[n]);
    const std::string& name = component.empty() ? grids[n].name : grids[n].attribute.name;
    if (!component.empty() && !arrays.empty() && arrays.back().array.name == name) {
      arrays.back().array.components.push_back(component);
      ++arrays.back().count;
    } else {
      arrays.push_back({{name, grids[n].kind != GridKind::material, {component}}, n, 1});
    }
  }
  return arrays;
}

formats::VtiGrid grid_of(const GridJob& job, const std::vector<ArrayGrids>& arrays) {
  const voxel::Lattice& lattice = job.request.lattice;
  formats::VtiGrid grid;
  const Vec3 middle = lattice.center(job.region.lo[0], job.region.lo[1], job.region.lo[2]);
  for (int axis = 0; axis < 3; ++axis) {
    const double pitch = lattice.pitch[static_cast<size_t>(axis)].mm();
    grid.count[static_cast<size_t>(axis)] = job.region.size(axis);
    grid.spacing_mm[axis] = pitch;
    grid.corner_mm[axis] = middle[axis] - pitch / 2;
  }
  for (const ArrayGrids& one : arrays) grid.arrays.push_back(one.array);
  grid.note = job.request.program + ", design " + job.request.design_hash + ", lengths in mm";
  return grid;
}

void put(std::string& bytes, size_t at, float value, bool is_float) {
  if (is_float)
    std::memcpy(bytes.data() + 4 * at, &value, sizeof value);
  else
    bytes[at] = static_cast<char>(static_cast<uint8_t>(value));
}

// Returns the array's numbers in a slab of layers, those of one voxel together.
std::string slab_numbers(const GridSlab& slab, const ArrayGrids& array) {
  std::string bytes(static_cast<size_t>(slab.box.voxels()) * array.array.bytes_per_voxel(), '\0');
  for (const FieldTile& tile : slab.tiles)
    for (size_t c = 0; c < array.count; ++c) {
      const float* from = tile.output(array.first + c);
      const TileBox& box = tile.box;
      for (int64_t k = box.lo[2]; k < box.hi[2]; ++k)
        for (int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
          auto at =
              static_cast<size_t>(((k - slab.box.lo[2]) * slab.box.size(1) + (j - slab.box.lo[1])) * slab.box.size(0) +
                                  (box.lo[0] - slab.box.lo[0]));
          for (int64_t i = 0; i < box.size(0); ++i, ++at, from += tile.is_uniform ? 0 : 1)
            put(bytes, at * array.count + c, *from, array.array.is_float);
        }
    }
  return bytes;
}

}  // namespace

GridReport write_vti(const GridJob& job, const std::string& path, int threads, Progress* progress,
                     const StopFlag* stop) {
  const Stopwatch watch;
  const std::vector<ArrayGrids> arrays = arrays_of(job.grids);
  GridReport report{{path}, 0, false, 0};
  exporting::VtiFile file(path, grid_of(job, arrays));
  const auto take = [&](const GridSlab& slab) {
    for (size_t n = 0; n < arrays.size(); ++n)
      file.write(n, slab.box.lo[2] - job.region.lo[2], slab_numbers(slab, arrays[n]));
    for (const FieldTile& tile : slab.tiles) report.has_inside = report.has_inside || has_inside(job, tile);
  };
  each_slab(job, threads, take, progress, stop);
  file.close();
  file.commit();
  report.bytes_written = file.bytes_written();
  report.seconds = watch.seconds();
  return report;
}

}  // namespace ombre::compile
