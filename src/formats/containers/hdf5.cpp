// Loads the module for HDF5 when the first file is read or written.
#include "formats/containers/hdf5.h"

#include "base/system/module_loader.h"
#include "base/text/error.h"

namespace ombre::formats {

const Module hdf5_library{"ombre_hdf5",  "HDF5",       "files of HDF5",
                          "libhdf5-dev", "OMBRE_HDF5", "write .vtu, or read .xdmf with its numbers as text"};

std::string hdf5_file(const std::vector<Hdf5Array>& arrays) {
  std::string bytes;
  if (!load_function<decltype(ombre_hdf5_write)>(hdf5_library, "ombre_hdf5_write")(&arrays, &bytes))
    throw Error(Code::memory, "HDF5 could not make the file; is there enough memory?");
  return bytes;
}

std::unique_ptr<Hdf5File> open_hdf5(std::string_view bytes) {
  return std::unique_ptr<Hdf5File>(load_function<decltype(ombre_hdf5_open)>(hdf5_library, "ombre_hdf5_open")(bytes));
}

}  // namespace ombre::formats
