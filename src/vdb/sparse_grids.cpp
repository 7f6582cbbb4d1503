// Loads the module of sparse grids when the first are made.
#include "vdb/sparse_grids.h"

#include <dlfcn.h>

#include <filesystem>

#include "base/error.h"
#include "vdb/grid_store.h"

namespace ombre::vdb {
namespace {

using MakeGridStore = decltype(&ombre_make_grid_store);

#ifdef OMBRE_OPENVDB_MODULE

// Beside this code, where it is installed, else where it was built.
std::string module_path() {
  const std::filesystem::path built = OMBRE_OPENVDB_MODULE;
  std::error_code ignored;
  Dl_info here{};
  if (dladdr(reinterpret_cast<void*>(&module_path), &here) != 0) {  // NOLINT
    const auto beside = std::filesystem::path(here.dli_fname).parent_path() / built.filename();
    if (std::filesystem::exists(beside, ignored)) return beside.string();
  }
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const auto installed = program.parent_path().parent_path() / "lib" / "ombre" / built.filename();
  return std::filesystem::exists(installed, ignored) ? installed.string() : built.string();
}

MakeGridStore load_module() {
  const std::string path = module_path();
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module) throw Error("sparse grids need " + path + ", which cannot be loaded: " + dlerror());  // NOLINT
  return reinterpret_cast<MakeGridStore>(dlsym(module, "ombre_make_grid_store"));                    // NOLINT
}

#else

MakeGridStore load_module() {
  throw Error(
      "this ombre was built without OpenVDB; install libopenvdb-dev and libnanovdb-dev, configure with "
      "-DOMBRE_OPENVDB=ON and build again, or write a .nrrd file");
}

#endif

}  // namespace

SparseGrids::SparseGrids(Vec3 spacing_mm, Vec3 origin_mm) {
  static const MakeGridStore make = load_module();
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
