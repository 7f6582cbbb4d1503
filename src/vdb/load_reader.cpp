// Loads the module of sparse grids when the first file is read.
#include "vdb/dense_grid.h"

#include "base/module_loader.h"
#include "vdb/grid_reader.h"
#include "vdb/module_path.h"

namespace ombre::vdb {

bool is_vdb(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with(" BDV\0\0\0\0"sv);
}

DenseGrid read_grid(const std::string& path, const std::string& name, int channel, const StopFlag* stop) {
  static const auto read = load_function<decltype(ombre_read_vdb_grid)>(
      openvdb_module, "ombre_read_vdb_grid", "sparse grids",
      "this ombre was built without OpenVDB; install libopenvdb-dev and libnanovdb-dev, configure with "
      "-DOMBRE_OPENVDB=ON and build again, or save the grid as a .nrrd file");
  DenseGrid grid;
  read(&path, &name, channel, stop, &grid);
  return grid;
}

}  // namespace ombre::vdb
