// Sparse grids in the form of OpenVDB and NanoVDB.
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
  level_set,  // distances within a narrow band around a surface; background beyond it, negated inside
  fog,        // densities; background where there is none
  labels,     // integers; 0 is background
  values,     // any numbers; background where none is set
};

enum class FileFormat { vdb, nvdb };

class GridStore;

// The voxels [lo, hi) along each axis.
struct IndexBox {
  std::array<int64_t, 3> lo{}, hi{};
};

// Grids on one lattice. Voxel (i, j, k) has its centre at origin + (i, j, k) * spacing. The order in which boxes are
// set does not matter. If a library fails, all functions except the constructor throw Error and nothing else.
class SparseGrids {
 public:
  using Notes = std::vector<std::pair<std::string, std::string>>;

  // Constructs a store without grids. Throws Error if this build lacks the libraries or they cannot be loaded.
  SparseGrids(Vec3 spacing_mm, Vec3 origin_mm);
  ~SparseGrids();
  SparseGrids(SparseGrids&&) noexcept;

  // Adds a grid filled with background and returns its number. The background of a level set is half the width of its
  // band.
  size_t add(const std::string& name, GridClass grid_class, float background, const Notes& notes);
  void fill(size_t grid, const IndexBox& box, float value);
  // Sets voxels from values, x fastest, then y, then z; NaN means background.
  void set(size_t grid, const IndexBox& box, const float* values);

  // Writes the grids; equal grids give equal bytes.
  void write(const std::string& path, FileFormat format);

 private:
  std::unique_ptr<GridStore> store_;
};

}  // namespace ombre::vdb
