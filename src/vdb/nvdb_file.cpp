// Writes .nvdb files.
#ifdef OMBRE_OPENVDB

#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "vdb/grid_files.h"

namespace ombre::vdb {
namespace {

// Converts the two types of grids used here. NanoVDB's own dispatch would compile code for all thirteen types that it
// supports.
nanovdb::GridHandle<> converted(const openvdb::GridBase::Ptr& grid) {
  if (const auto floats = openvdb::GridBase::grid<openvdb::FloatGrid>(grid)) return nanovdb::openToNanoVDB(*floats);
  if (const auto ids = openvdb::GridBase::grid<openvdb::Int32Grid>(grid)) return nanovdb::openToNanoVDB(*ids);
  throw std::runtime_error("a grid of " + grid->type() + " cannot be written as .nvdb");
}

}  // namespace

void write_nvdb(const std::string& path, const openvdb::GridPtrVec& grids) {
  std::vector<nanovdb::GridHandle<>> handles;
  for (const openvdb::GridBase::Ptr& grid : grids) handles.push_back(converted(grid));
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  nanovdb::io::writeGrids(file, handles);
  file.close();
  if (!file) throw std::runtime_error("the disk is full, or fails");
}

}  // namespace ombre::vdb

#endif
