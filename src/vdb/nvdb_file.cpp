// .nvdb files.
#ifdef OMBRE_OPENVDB

#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>

#include <fstream>
#include <stdexcept>
#include <vector>

#include "vdb/grid_files.h"

namespace ombre::vdb {

void write_nvdb(const std::string& path, const openvdb::GridPtrVec& grids) {
  std::vector<nanovdb::GridHandle<>> handles;
  for (const openvdb::GridBase::Ptr& grid : grids) handles.push_back(nanovdb::openToNanoVDB(grid));
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  nanovdb::io::writeGrids(file, handles);
  file.close();
  if (!file) throw std::runtime_error("the disk is full, or fails");
}

}  // namespace ombre::vdb

#endif
