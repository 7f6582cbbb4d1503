// Writes grids of a job as one sparse file: .vdb and .nvdb.
#include "jobs/grid/sparse_file.h"

#include <filesystem>

#include "base/system/stopwatch.h"
#include "export/output_file.h"

namespace ombre::compile {
namespace {

vdb::GridClass class_of(GridKind kind) {
  switch (kind) {
    case GridKind::fraction:
      return vdb::GridClass::fog;
    case GridKind::distance:
      return vdb::GridClass::level_set;
    case GridKind::attribute:
      return vdb::GridClass::values;
    default:
      return vdb::GridClass::labels;
  }
}

std::string hex(const formats::Rgba& rgba) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text = "#";
  for (const uint8_t channel : rgba) text += {digits[channel >> 4], digits[channel & 15]};
  return text;
}

vdb::SparseGrids::Notes notes_of(const GridJob& job, const Grid& grid) {
  vdb::SparseGrids::Notes notes{{"creator", job.request.program},
                                {"design_hash", job.request.design_hash},
                                {"unit", grid.kind == GridKind::attribute ? grid.attribute.unit : "mm"}};
  if (grid.kind == GridKind::distance) notes.emplace_back("distance", std::string(design::name(job.metric.kind)));
  if (grid.material) notes.emplace_back("colour", hex(grid.material->rgba));
  if (grid.kind == GridKind::material)
    for (const SliceMaterial& material : job.request.materials)
      notes.emplace_back("material " + std::to_string(material.id), material.name + " " + hex(material.rgba));
  return notes;
}

vdb::SparseGrids empty_grids(const GridJob& job) {
  const auto& pitch = job.request.lattice.pitch;
  vdb::SparseGrids grids({pitch[0].mm(), pitch[1].mm(), pitch[2].mm()}, job.request.lattice.center(0, 0, 0));
  for (const Grid& grid : job.grids) {
    const double background =
        grid.kind == GridKind::distance ? job.band_mm : design::default_of(grid.attribute, grid.name);
    grids.add(grid.name, class_of(grid.kind), static_cast<float>(background), notes_of(job, grid));
  }
  return grids;
}

}  // namespace

GridReport write_sparse(const GridJob& job, const std::string& path, vdb::FileFormat format, int threads,
                        Progress* progress, const StopFlag* stop) {
  const Stopwatch watch;
  vdb::SparseGrids grids = empty_grids(job);
  exporting::NewFile file(path);
  GridReport report{{path}, 0, false, 0};
  const auto take = [&](const GridSlab& slab) {
    for (const voxel::FieldTile& tile : slab.tiles) {
      report.has_inside = report.has_inside || has_inside(job, tile);
      const vdb::IndexBox box{tile.box.lo, tile.box.hi};
      for (size_t n = 0; n < job.grids.size(); ++n)
        tile.is_uniform ? grids.fill(n, box, *tile.output(n)) : grids.set(n, box, tile.output(n));
    }
  };
  each_slab(job, threads, take, progress, stop);
  grids.write(file.part(), format);
  file.close();
  report.bytes_written = std::filesystem::file_size(file.part());
  file.commit();
  report.seconds = watch.seconds();
  return report;
}

}  // namespace ombre::compile
