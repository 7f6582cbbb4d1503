// Loads the module for sparse grids when the first file is read.
#include "vdb/dense_grid.h"

#include "base/system/module_loader.h"
#include "vdb/grid_reader.h"

namespace ombre::vdb {
namespace {

constexpr Module reader_module{"ombre_openvdb", "OpenVDB",
                               "sparse grids",  "libopenvdb-dev and libnanovdb-dev",
                               "OMBRE_OPENVDB", "save the grid as a .nrrd file"};

}  // namespace

std::vector<ombre::FileFormat> file_formats() {
  return {{"OpenVDB", {".vdb"}, Content::volume, true, true, &reader_module},
          {"NanoVDB", {".nvdb"}, Content::volume, false, true, &reader_module}};
}

bool is_vdb(std::string_view bytes) {
  using namespace std::string_view_literals;
  return bytes.starts_with(" BDV\0\0\0\0"sv);
}

DenseGrid read_grid(const std::string& path, const std::string& name, int channel, const StopFlag* stop) {
  static const auto read = load_function<decltype(ombre_read_vdb_grid)>(reader_module, "ombre_read_vdb_grid");
  DenseGrid grid;
  read(&path, &name, channel, stop, &grid);
  return grid;
}

}  // namespace ombre::vdb
