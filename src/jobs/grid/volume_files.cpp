// Writes grids of a job as dense files: raw, .npy and .nrrd.
#include "jobs/grid/volume_files.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <utility>

#include "base/system/stopwatch.h"
#include "jobs/slice/layer_files.h"

namespace ombre::compile {
namespace {

using voxel::FieldTile;
using voxel::TileBox;

Data colour(const formats::Rgba& rgba) {
  DataList list;
  for (const uint8_t channel : rgba) list.emplace_back(static_cast<double>(channel));
  return list;
}

Data described(const SliceMaterial& material) {
  return DataMembers{
      {"id", static_cast<double>(material.id)}, {"name", material.name}, {"rgba", colour(material.rgba)}};
}

Data all_materials(const Sampling& request) {
  DataList list;
  for (const SliceMaterial& material : request.materials) list.push_back(described(material));
  return list;
}

bool is_float(const Grid& grid) { return grid.kind != GridKind::material; }

// Describes the numbers of a grid.
DataMembers about(const GridJob& job, const Grid& grid) {
  const Sampling& request = job.request;
  DataMembers members{{"program", request.program}, {"design_hash", request.design_hash}};
  const auto add = [&](const char* key, Data value) { members.emplace_back(key, std::move(value)); };
  switch (grid.kind) {
    case GridKind::material:
      add("values", "material ids, 0 is void");
      add("dither", std::string(name(request.dither)));
      add("seed", std::to_string(request.seed));
      add("materials", all_materials(request));
      break;
    case GridKind::fraction:
      add("values", "fraction of a material");
      add("material", described(*grid.material));
      break;
    case GridKind::distance:
      add("values", "distance to the surface in mm, negative inside");
      add("distance", std::string(design::name(job.metric.kind)));
      break;
    case GridKind::attribute:
      add("values", "an attribute, its default outside");
      add("attribute", DataMembers{{"name", grid.name},
                                   {"unit", grid.attribute.unit},
                                   {"default", design::default_of(grid.attribute, grid.name)}});
      break;
  }
  return members;
}

exporting::Volume volume_of(const GridJob& job, const Grid& grid) {
  const voxel::Lattice& lattice = job.request.lattice;
  exporting::Volume volume;
  volume.is_float = is_float(grid);
  for (size_t axis = 0; axis < 3; ++axis) {
    volume.count[axis] = job.region.size(static_cast<int>(axis));
    volume.spacing_mm[static_cast<int>(axis)] = lattice.pitch[axis].mm();
  }
  volume.origin_mm = lattice.center(job.region.lo[0], job.region.lo[1], job.region.lo[2]);
  volume.about = about(job, grid);
  return volume;
}

// The numbers of one grid in a slab, in the order of the file.
class SlabNumbers {
 public:
  SlabNumbers(const TileBox& slab, bool is_float)
      : slab_(slab),
        is_float_(is_float),
        bytes_(static_cast<size_t>(slab.voxels()) * (is_float ? sizeof(float) : 1), 0) {}

  void take(const FieldTile& tile, size_t output) {
    const float* from = tile.output(output);
    const auto width = static_cast<size_t>(tile.box.size(0));
    for (int64_t k = tile.box.lo[2]; k < tile.box.hi[2]; ++k)
      for (int64_t j = tile.box.lo[1]; j < tile.box.hi[1]; ++j) {
        put(from, tile.is_uniform, width, offset(tile.box.lo[0], j, k));
        if (!tile.is_uniform) from += width;
      }
  }

  std::string bytes() && { return std::move(bytes_); }

 private:
  size_t offset(int64_t i, int64_t j, int64_t k) const {
    return static_cast<size_t>(((k - slab_.lo[2]) * slab_.size(1) + (j - slab_.lo[1])) * slab_.size(0) +
                               (i - slab_.lo[0]));
  }

  void put(const float* from, bool is_uniform, size_t width, size_t at) {
    for (size_t n = 0; n < width; ++n) {
      const float value = from[is_uniform ? 0 : n];
      if (is_float_)
        std::memcpy(bytes_.data() + (at + n) * sizeof value, &value, sizeof value);
      else
        bytes_[at + n] = static_cast<char>(static_cast<uint8_t>(value));
    }
  }

  TileBox slab_;
  bool is_float_;
  std::string bytes_;
};

}  // namespace

void each_numbers(const GridJob& job, int threads, const TakeNumbers& take, Progress* progress, const StopFlag* stop) {
  const auto take_slab = [&](const GridSlab& slab) {
    SlabOfNumbers numbers{slab.box, {}, false};
    for (size_t n = 0; n < job.grids.size(); ++n) {
      SlabNumbers of_grid(slab.box, is_float(job.grids[n]));
      for (const FieldTile& tile : slab.tiles) of_grid.take(tile, n);
      numbers.bytes.push_back(std::move(of_grid).bytes());
    }
    for (const FieldTile& tile : slab.tiles) numbers.has_inside = numbers.has_inside || has_inside(job, tile);
    take(numbers);
  };
  each_slab(job, threads, take_slab, progress, stop);
}

std::vector<VolumeInMemory> volumes_in_memory(const GridJob& job, int threads, Progress* progress,
                                              const StopFlag* stop) {
  std::vector<VolumeInMemory> volumes;
  for (const Grid& grid : job.grids) {
    volumes.push_back({volume_of(job, grid), {}});
    volumes.back().numbers.reserve(volumes.back().volume.bytes());
  }
  const auto take = [&](const SlabOfNumbers& slab) {
    for (size_t n = 0; n < volumes.size(); ++n) volumes[n].numbers += slab.bytes[n];
  };
  each_numbers(job, threads, take, progress, stop);
  return volumes;
}

std::vector<std::string> volume_paths(const std::string& path, const std::vector<Grid>& grids) {
  const bool is_of_many = grids[0].kind == GridKind::fraction;
  if (grids.size() == 1 && !is_of_many) return {path};
  std::vector<std::string> names, paths;
  for (const Grid& grid : grids) names.push_back(grid.name);
  const std::filesystem::path whole(path);
  for (const std::string& word : file_words(names))
    paths.push_back((whole.parent_path() / (whole.stem().string() + "_" + word + whole.extension().string())).string());
  return paths;
}

std::vector<uint64_t> numbers_bytes(const GridJob& job, int64_t layers) {
  std::vector<uint64_t> bytes;
  for (const Grid& grid : job.grids)
    bytes.push_back(volume_of(job, grid).layer_bytes() * static_cast<uint64_t>(layers));
  return bytes;
}

uint64_t volume_bytes(const GridJob& job) {
  const std::vector<uint64_t> bytes = numbers_bytes(job, job.region.size(2));
  return std::accumulate(bytes.begin(), bytes.end(), uint64_t{0});
}

VolumeFiles::VolumeFiles(const GridJob& job, const std::vector<std::string>& paths, const DenseFormat& format) {
  for (size_t n = 0; n < paths.size(); ++n)
    files_.push_back(std::make_unique<exporting::VolumeFile>(paths[n], *format.format, volume_of(job, job.grids[n]),
                                                             format.is_gzip));
}

uint64_t VolumeFiles::commit() {
  uint64_t bytes = 0;
  for (auto& file : files_) file->close();
  for (auto& file : files_) {
    file->commit();
    bytes += file->bytes_written();
  }
  return bytes;
}

GridReport write_volumes(const GridJob& job, const std::vector<std::string>& paths, const DenseFormat& format,
                         int threads, Progress* progress, const StopFlag* stop) {
  const Stopwatch watch;
  GridReport report{paths, 0, false, 0};
  VolumeFiles files(job, paths, format);
  const auto take = [&](const SlabOfNumbers& slab) {
    for (size_t n = 0; n < paths.size(); ++n) files.append(n, slab.bytes[n]);
    report.has_inside = report.has_inside || slab.has_inside;
  };
  each_numbers(job, threads, take, progress, stop);
  report.bytes_written = files.commit();
  report.seconds = watch.seconds();
  return report;
}

}  // namespace ombre::compile
