// The interface between SparseGrids and the module with OpenVDB, which takes longer to load than most jobs take to run.
#pragma once

#include "vdb/sparse_grids.h"

namespace ombre::vdb {

// A store of grids with the functions of SparseGrids.
class GridStore {
 public:
  using Notes = SparseGrids::Notes;
  virtual ~GridStore() = default;
  virtual size_t add(const std::string& name, GridClass grid_class, float background, const Notes& notes) = 0;
  virtual void fill(size_t grid, const IndexBox& box, float value) = 0;
  virtual void set(size_t grid, const IndexBox& box, const float* values) = 0;
  virtual void write(const std::string& path, FileFormat format) = 0;
};

}  // namespace ombre::vdb

// Makes a store; the function that the module exports.
extern "C" ombre::vdb::GridStore* ombre_make_grid_store(const ombre::Vec3* spacing, const ombre::Vec3* origin);
