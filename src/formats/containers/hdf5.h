// Arrays of numbers in files of HDF5. The library lies in a module that is loaded when it is needed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ombre::formats {

struct Hdf5Array {
  enum class Kind : uint8_t { float32, float64, int64 };

  std::string path;  // "/Mesh/geometry"; groups are made as they are needed
  Kind kind = Kind::float64;
  std::vector<uint64_t> sizes;  // the last one changes fastest
  const void* numbers = nullptr;
};

// The bytes of a file; they do not depend on the time. Throws Error where the program was built without HDF5.
std::string hdf5_file(const std::vector<Hdf5Array>& arrays);

struct Hdf5Numbers {
  std::vector<uint64_t> sizes;
  std::vector<double> values;
};

// The array at a path; nothing where there is none of numbers, or it is not whole. Throws Error where the bytes are no
// HDF5 file, or the program was built without HDF5.
std::optional<Hdf5Numbers> hdf5_numbers(std::string_view bytes, const std::string& path);

}  // namespace ombre::formats

// The functions that the module exports: false where it fails.
extern "C" bool ombre_hdf5_write(const std::vector<ombre::formats::Hdf5Array>* arrays, std::string* bytes);
// `is_file` says whether the bytes are a file of HDF5 at all.
extern "C" bool ombre_hdf5_read(std::string_view bytes, const char* path, ombre::formats::Hdf5Numbers* numbers,
                                bool* is_file);
