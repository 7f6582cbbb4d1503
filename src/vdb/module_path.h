// Where the module of sparse grids was built; null in builds without OpenVDB.
#pragma once

namespace ombre::vdb {

#ifdef OMBRE_OPENVDB_MODULE
inline constexpr const char* openvdb_module = OMBRE_OPENVDB_MODULE;
#else
inline constexpr const char* openvdb_module = nullptr;
#endif

}  // namespace ombre::vdb
