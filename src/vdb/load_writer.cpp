// Loads the module for sparse grids when the first are made.
#include "vdb/sparse_grids.h"

#include "base/system/module_loader.h"
#include "vdb/grid_store.h"

namespace ombre::vdb {
namespace {

constexpr Module writer_module{"ombre_openvdb", "OpenVDB",
                               "sparse grids",  "libopenvdb-dev and libnanovdb-dev",
                               "OMBRE_OPENVDB", "write a .nrrd file"};

}  // namespace

SparseGrids::SparseGrids(Vec3 spacing_mm, Vec3 origin_mm) {
  static const auto make = load_function<decltype(ombre_make_grid_store)>(writer_module, "ombre_make_grid_store");
  store_.reset(make(&spacing_mm, &origin_mm));
}

SparseGrids::~SparseGrids() = default;
SparseGrids::SparseGrids(SparseGrids&&) noexcept = default;

size_t SparseGrids::add(const std::string& name, GridClass grid_class, float background, const Notes& notes) {
  return store_->add(name, grid_class, background, notes);
}
void SparseGrids::fill(size_t grid, const IndexBox& box, float value) { store_->fill(grid, box, value); }
void SparseGrids::set(size_t grid, const IndexBox& box, const float* values) { store_->set(grid, box, values); }
void SparseGrids::write(const std::string& path, FileFormat format) { store_->write(path, format); }

}  // namespace ombre::vdb
