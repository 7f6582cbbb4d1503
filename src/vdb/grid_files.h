// Grids of OpenVDB as files. Only for this folder: it includes the library's headers.
#pragma once

#include <openvdb/openvdb.h>

#include <string>

namespace ombre::vdb {

// Equal grids give equal bytes. Both throw what the library or the standard library throws.
void write_vdb(const std::string& path, const openvdb::GridPtrVec& grids);
void write_nvdb(const std::string& path, const openvdb::GridPtrVec& grids);

}  // namespace ombre::vdb
