// Arrays of numbers in HDF5 files. The library is in a module that is loaded on demand.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/module_loader.h"

namespace ombre::formats {

extern const Module hdf5_library;

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

// Rows of an array, counted along its first axis.
struct Hdf5Rows {
  uint64_t first = 0, count = UINT64_MAX;  // the greatest count stands for all rows from the first one
};

// A file that is open. Links to other files are not followed.
class Hdf5File {
 public:
  Hdf5File() = default;
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;
  virtual ~Hdf5File() = default;

  // Returns the array at a path, or some of its rows; null if it is not there, or has no numbers or fewer rows.
  // `problem` then says what else is wrong with it: "its numbers lie in other files".
  virtual std::optional<Hdf5Numbers> numbers(const std::string& path, std::string& problem,
                                             Hdf5Rows rows = {}) const = 0;
  // Returns the sizes of an array; empty if there is none.
  virtual std::vector<uint64_t> sizes(const std::string& path) const = 0;
  // Returns the names of the arrays in a group, sorted; empty if there is no such group.
  virtual std::vector<std::string> arrays_in(const std::string& group) const = 0;
  // Returns a text or a few numbers that are attached to a group; null if there are none.
  virtual std::optional<std::string> text(const std::string& group, const std::string& name) const = 0;
  virtual std::optional<std::vector<double>> few_numbers(const std::string& group, const std::string& name) const = 0;
};

// Opens a file; null if the bytes, which must outlive it, are no file of HDF5, or are damaged. Its functions throw
// Error if the library crashes or hangs on the file. Throws Error in builds without HDF5.
std::unique_ptr<Hdf5File> open_hdf5(std::string_view bytes);

}  // namespace ombre::formats

// The functions that the module exports. The first returns false on failure, the second null.
extern "C" bool ombre_hdf5_write(const std::vector<ombre::formats::Hdf5Array>* arrays, std::string* bytes);
extern "C" ombre::formats::Hdf5File* ombre_hdf5_open(std::string_view bytes);
