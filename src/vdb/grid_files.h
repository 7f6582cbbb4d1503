// Writes grids of OpenVDB to files. Only for this folder, because it includes the library's headers.
#pragma once

#include <openvdb/openvdb.h>

#include <string>

namespace ombre::vdb {

// write_vdb() and write_nvdb() write equal bytes for equal grids, and throw exceptions of the library and of the
// standard library.
void write_vdb(const std::string& path, const openvdb::GridPtrVec& grids);
void write_nvdb(const std::string& path, const openvdb::GridPtrVec& grids);

}  // namespace ombre::vdb
