// Sparse grids as OpenVDB and NanoVDB have them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/math/vec.h"

namespace ombre::vdb {

enum class GridClass {
  level_set,  // distances within a narrow band around a surface; beyond it the background, negative inside
  fog,        // amounts; where there is none is background
  labels,     // whole numbers; 0 is background
  values,     // any numbers; what nothing is said of is background
};

enum class FileFormat { vdb, nvdb };

class GridStore;

// Voxels [lo, hi) on each axis.
struct IndexBox {
  std::array<int64_t, 3> lo{}, hi{};
};

// Grids on one lattice. Voxel (i, j, k) has its centre at origin + (i, j, k) * spacing. The values of boxes in
// any order give the same grids. All but the constructor throw Error, and nothing else, when a library fails.
class SparseGrids {
 public:
  using Notes = std::vector<std::pair<std::string, std::string>>;

  // Throws Error when this was built without the libraries, or they cannot be loaded.
  SparseGrids(Vec3 spacing_mm, Vec3 origin_mm);
  ~SparseGrids();
  SparseGrids(SparseGrids&&) noexcept;

  // A grid of background; returns its number. Of a level set, the background is half the width of its band.
  size_t add(const std::string& name, GridClass grid_class, float background, const Notes& notes);
  void fill(size_t grid, const IndexBox& box, float value);
  // x fastest, then y, then z. What is no number is background.
  void set(size_t grid, const IndexBox& box, const float* values);

  // Equal grids give equal bytes.
  void write(const std::string& path, FileFormat format);

 private:
  std::unique_ptr<GridStore> store_;
};

}  // namespace ombre::vdb
