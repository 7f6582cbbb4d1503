// Arrays of numbers in HDF5 files. The library is in a module that is loaded on demand.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

struct Hdf5Array {
  enum class Kind : uint8_t { float32, float64, int64 };

  std::string path;  // such as "/Mesh/geometry"; groups are created as necessary
  Kind kind = Kind::float64;
  std::vector<uint64_t> sizes;  // the last one varies fastest
  const void* numbers = nullptr;
};

// Returns the bytes of a file, which do not depend on the time. Throws Error in builds without HDF5.
std::string hdf5_file(const std::vector<Hdf5Array>& arrays);

struct Hdf5Numbers {
  std::vector<uint64_t> sizes;
  std::vector<double> values;
};

// Returns the array at a path; null if there is none, if it has no numbers, or if it is incomplete. Throws Error if the
// bytes are not an HDF5 file, and in builds without HDF5.
std::optional<Hdf5Numbers> hdf5_numbers(std::string_view bytes, const std::string& path);

}  // namespace ombre::formats

// The functions that the module exports; they return false on failure.
extern "C" bool ombre_hdf5_write(const std::vector<ombre::formats::Hdf5Array>* arrays, std::string* bytes);
// `is_file` is set to whether the bytes are an HDF5 file.
extern "C" bool ombre_hdf5_read(std::string_view bytes, const char* path, ombre::formats::Hdf5Numbers* numbers,
                                bool* is_file);
