// The module for HDF5 files in memory.
#include <hdf5.h>

#include <algorithm>

#include "formats/containers/hdf5.h"

namespace {

using ombre::formats::Hdf5Array;
using ombre::formats::Hdf5Numbers;

constexpr size_t growth = size_t{1} << 20;  // bytes by which a file in memory grows
constexpr uint64_t most_numbers = uint64_t{1} << 32;

// An object of the library that is closed by the destructor.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  operator hid_t() const { return id_; }  // NOLINT: what the library's functions take
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

hid_t file_type(Hdf5Array::Kind kind) {
  if (kind == Hdf5Array::Kind::int64) return H5T_STD_I64LE;
  return kind == Hdf5Array::Kind::float32 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
}

hid_t memory_type(Hdf5Array::Kind kind) {
  if (kind == Hdf5Array::Kind::int64) return H5T_NATIVE_INT64;
  return kind == Hdf5Array::Kind::float32 ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
}

bool write_array(hid_t file, const Hdf5Array& array) {
  const std::vector<hsize_t> sizes(array.sizes.begin(), array.sizes.end());
  const Handle space(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose);
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose), options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(links, 1);
  H5Pset_obj_track_times(options, false);
  const Handle set(H5Dcreate2(file, array.path.c_str(), file_type(array.kind), space, links, options, H5P_DEFAULT),
                   H5Dclose);
  return set.is_open() && H5Dwrite(set, memory_type(array.kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.numbers) >= 0;
}

bool take_image(hid_t file, std::string& bytes) {
  if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0) return false;
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size <= 0) return false;
  bytes.resize(static_cast<size_t>(size));
  return H5Fget_file_image(file, bytes.data(), bytes.size()) == size;
}

bool read_array(hid_t file, const char* path, Hdf5Numbers& numbers) {
  const Handle set(H5Dopen2(file, path, H5P_DEFAULT), H5Dclose);
  if (!set.is_open()) return false;
  const Handle type(H5Dget_type(set), H5Tclose), space(H5Dget_space(set), H5Sclose);
  const H5T_class_t kind = H5Tget_class(type);
  const int axes = H5Sget_simple_extent_ndims(space);
  if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || axes < 1 || axes > 8) return false;
  std::vector<hsize_t> sizes(static_cast<size_t>(axes));
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  uint64_t count = 1;
  for (const hsize_t size : sizes) {
    if (size > most_numbers || count * size > most_numbers) return false;
    count *= size;
  }
  numbers.sizes.assign(sizes.begin(), sizes.end());
  numbers.values.resize(count);
  return H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.values.data()) >= 0;
}

}  // namespace

bool ombre_hdf5_write(const std::vector<Hdf5Array>* arrays, std::string* bytes) {
  be_quiet();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_fapl_core(access, growth, false);
  H5Pset_obj_track_times(creation, false);
  const Handle file(H5Fcreate("ombre.h5", H5F_ACC_TRUNC, creation, access), H5Fclose);
  return file.is_open() &&
         std::ranges::all_of(*arrays, [&](const Hdf5Array& array) { return write_array(file, array); }) &&
         take_image(file, *bytes);
}

bool ombre_hdf5_read(std::string_view bytes, const char* path, Hdf5Numbers* numbers, bool* is_file) {
  be_quiet();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, growth, false);
  std::string copy(bytes);
  H5Pset_file_image(access, copy.data(), copy.size());
  const Handle file(H5Fopen("ombre.h5", H5F_ACC_RDONLY, access), H5Fclose);
  *is_file = file.is_open();
  return *is_file && read_array(file, path, *numbers);
}
