// Loads the module for HDF5 when the first file is read or written.
#include "formats/containers/hdf5.h"

#include "base/system/module_loader.h"
#include "base/text/error.h"

namespace ombre::formats {
namespace {

constexpr Module hdf5{"ombre_hdf5",  "HDF5",       "files of HDF5",
                      "libhdf5-dev", "OMBRE_HDF5", "write .vtu, or read .xdmf with its numbers as text"};

}  // namespace

std::string hdf5_file(const std::vector<Hdf5Array>& arrays) {
  std::string bytes;
  if (!load_function<decltype(ombre_hdf5_write)>(hdf5, "ombre_hdf5_write")(&arrays, &bytes))
    throw Error(Code::memory, "HDF5 could not make the file; is there enough memory?");
  return bytes;
}

std::optional<Hdf5Numbers> hdf5_numbers(std::string_view bytes, const std::string& path) {
  const auto read = load_function<decltype(ombre_hdf5_read)>(hdf5, "ombre_hdf5_read");
  Hdf5Numbers numbers;
  bool is_file = false;
  if (read(bytes, path.c_str(), &numbers, &is_file)) return numbers;
  if (!is_file) throw Error(Code::file_content, "this is no file of HDF5, or it is damaged", {{"file", path}});
  return std::nullopt;
}

}  // namespace ombre::formats
