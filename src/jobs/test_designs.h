// Makes layers in memory from the text of a design, for tests.
#pragma once

#include <gtest/gtest.h>

#include <unistd.h>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "base/system/test_source_files.h"
#include "jobs/slice/plan.h"
#include "load/load.h"

namespace ombre::compile {

inline void use_source_data() { setenv("OMBRE_DATA", source_file().c_str(), 1); }

inline LoadedPtr load_text(const std::string& text, Diagnostics& diagnostics, const std::string& ending = ".vcad") {
  use_source_data();
  const std::string path = testing::TempDir() + "design" + std::to_string(getpid()) + ending;
  std::ofstream(path) << text;
  LoadedPtr loaded = load_design(path, {}, diagnostics);
  std::remove(path.c_str());
  return loaded;
}

// Every voxel of a job: material ids, x fastest, then y, then z.
struct Voxels {
  voxel::Lattice lattice;
  std::vector<MaterialId> ids;
  std::vector<SliceMaterial> materials;

  MaterialId at(int64_t i, int64_t j, int64_t k) const {
    return ids[static_cast<size_t>((k * lattice.count[1] + j) * lattice.count[0] + i)];
  }
  MaterialId id(const std::string& name) const {
    for (const auto& m : materials)
      if (m.name == name) return m.id;
    return 0;
  }
  double voxel_mm3() const { return lattice.pitch[0].mm() * lattice.pitch[1].mm() * lattice.pitch[2].mm(); }
  double volume() const {
    size_t count = 0;
    for (const MaterialId id : ids) count += id != 0;
    return static_cast<double>(count) * voxel_mm3();
  }
};

inline std::vector<MaterialId> unpack(const std::vector<voxel::LayerResult>& layers) {
  std::vector<MaterialId> ids;
  for (const auto& layer : layers) {
    for (uint32_t j = 0; j < layer.materials().height(); ++j) {
      ids.resize(ids.size() + layer.materials().width());
      layer.materials().row(j).unpack(ids.data() + ids.size() - layer.materials().width());
    }
  }
  return ids;
}

inline Voxels slice_text(const std::string& text, const PlanOptions& options = {}, int64_t slab = 8) {
  Diagnostics diagnostics;
  const LoadedPtr loaded = load_text(text, diagnostics);
  const auto plan = loaded ? plan_slice(loaded, options, diagnostics) : std::nullopt;
  EXPECT_FALSE(diagnostics.has_errors()) << to_text(diagnostics);
  if (!plan) return {};
  Voxels voxels{plan->request.lattice, {}, plan->request.materials};
  for (int64_t k = 0; k < voxels.lattice.count[2]; k += slab) {
    const auto part = unpack(plan->producer(k, std::min(k + slab, voxels.lattice.count[2]), nullptr));
    voxels.ids.insert(voxels.ids.end(), part.begin(), part.end());
  }
  return voxels;
}

}  // namespace ombre::compile
