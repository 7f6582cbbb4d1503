#include "formats/hdf5.h"

#include "base/error.h"
#include "base/module_loader.h"

namespace ombre::formats {

#ifdef OMBRE_HDF5_MODULE

std::string hdf5_file(const std::vector<Hdf5Array>& arrays) {
  std::string bytes;
  if (!load_function<decltype(ombre_hdf5_write)>(OMBRE_HDF5_MODULE, "ombre_hdf5_write", "files of HDF5")(&arrays,
                                                                                                         &bytes))
    throw Error(Code::memory, "HDF5 could not make the file; is there enough memory?");
  return bytes;
}

std::optional<Hdf5Numbers> hdf5_numbers(std::string_view bytes, const std::string& path) {
  const auto read = load_function<decltype(ombre_hdf5_read)>(OMBRE_HDF5_MODULE, "ombre_hdf5_read", "files of HDF5");
  Hdf5Numbers numbers;
  bool is_file = false;
  if (read(bytes, path.c_str(), &numbers, &is_file)) return numbers;
  if (!is_file) throw Error(Code::file_content, "this is no file of HDF5, or it is damaged", {{"file", path}});
  return std::nullopt;
}

#else

namespace {
constexpr const char* without_hdf5 = "this build of ombre has no HDF5 (OMBRE_HDF5)";
}  // namespace

std::string hdf5_file(const std::vector<Hdf5Array>& /*arrays*/) { throw Error(Code::library_missing, without_hdf5); }

std::optional<Hdf5Numbers> hdf5_numbers(std::string_view /*bytes*/, const std::string& /*path*/) {
  throw Error(Code::library_missing, without_hdf5);
}

#endif

}  // namespace ombre::formats
