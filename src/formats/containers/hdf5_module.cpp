// The module for HDF5 files in memory.
#include <hdf5.h>

#include <algorithm>
#include <mutex>

#include "base/system/not_copied.h"
#include "formats/containers/hdf5.h"

namespace {

using ombre::formats::Hdf5Array;
using ombre::formats::Hdf5File;
using ombre::formats::Hdf5Numbers;
using ombre::formats::Hdf5Rows;

constexpr size_t growth = size_t{1} << 20;  // bytes by which a file in memory grows
constexpr uint64_t greatest_ratio = 1032;   // of deflate, by which arrays may be packed
constexpr int most_axes = 8;

// The library does not take calls from several threads at once.
std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

// Returns a name that no other file has, since the library takes files in memory with equal names for the same one.
std::string new_name() {
  static uint64_t count = 0;
  return "ombre" + std::to_string(++count) + ".h5";
}

// A turn to use the library, which prints nothing.
class Turn {
 public:
  Turn() : lock_(library_mutex()) { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

 private:
  std::lock_guard<std::mutex> lock_;
};

// An object of the library that is closed by the destructor.
class Handle : ombre::NotCopied {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() { close(); }

  void close() {
    if (id_ >= 0) close_(id_);
    id_ = -1;
  }

  operator hid_t() const { return id_; }  // NOLINT: what the library's functions take
  bool is_open() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

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

// Refuses links to other files, which the library would open.
herr_t refuse_link(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) { return -1; }

class OpenFile : public Hdf5File {
 public:
  explicit OpenFile(hid_t file) : file_(file, H5Fclose) {}
  ~OpenFile() override {
    const Turn turn;
    file_.close();
  }

  std::optional<Hdf5Numbers> numbers(const std::string& path, std::string& problem, Hdf5Rows rows) const override {
    const Turn turn;
    const Handle set = array_at(path);
    Hdf5Numbers numbers;
    numbers.sizes = sizes_of(set);
    if (numbers.sizes.empty() || !has_numbers(set)) return std::nullopt;
    if (lies_elsewhere(set)) {
      problem = "its numbers lie in other files";
      return std::nullopt;
    }
    const uint64_t all = numbers.sizes.front();
    if (rows.count == UINT64_MAX && rows.first <= all) rows.count = all - rows.first;
    if (rows.first > all || rows.count > all - rows.first) {
      problem = "it has " + std::to_string(all) + " rows";
      return std::nullopt;
    }
    numbers.sizes.front() = rows.count;
    if (!can_hold(numbers.sizes, H5Tget_size(Handle(H5Dget_type(set), H5Tclose)))) {
      problem = "it states more numbers than the file can hold";
      return std::nullopt;
    }
    if (read_rows(set, rows.first, numbers)) return numbers;
    problem = "its numbers are damaged, or packed in a way that HDF5 does not know here";
    return std::nullopt;
  }

  std::vector<uint64_t> sizes(const std::string& path) const override {
    const Turn turn;
    return sizes_of(array_at(path));
  }

  std::vector<std::string> arrays_in(const std::string& path) const override {
    const Turn turn;
    std::vector<std::string> names;
    const Handle group = group_at(path);
    H5G_info_t info{};
    if (!group.is_open() || H5Gget_info(group, &info) < 0) return names;
    for (hsize_t n = 0; n < std::min<hsize_t>(info.nlinks, most_links); ++n) {
      const ssize_t size = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, n, nullptr, 0, H5P_DEFAULT);
      if (size <= 0) continue;
      std::string name(static_cast<size_t>(size) + 1, '\0');
      H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, n, name.data(), name.size(), H5P_DEFAULT);
      name.pop_back();
      std::string array = path;
      array += '/';
      array += name;
      if (array_at(array).is_open()) names.push_back(std::move(name));
    }
    return names;
  }

  std::optional<std::string> text(const std::string& group, const std::string& name) const override {
    const Turn turn;
    const Handle attribute = attribute_of(group, name);
    if (!attribute.is_open() || count_of(attribute) != 1) return std::nullopt;
    const Handle type(H5Aget_type(attribute), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING) return std::nullopt;
    if (H5Tis_variable_str(type) > 0) {
      char* found = nullptr;
      if (H5Aread(attribute, type, &found) < 0 || !found) return std::nullopt;
      std::string text = found;
      H5free_memory(found);
      return text;
    }
    std::string text(H5Tget_size(type), '\0');
    if (text.size() > most_text || H5Aread(attribute, type, text.data()) < 0) return std::nullopt;
    return text.substr(0, text.find('\0'));
  }

  std::optional<std::vector<double>> few_numbers(const std::string& group, const std::string& name) const override {
    const Turn turn;
    const Handle attribute = attribute_of(group, name);
    if (!attribute.is_open()) return std::nullopt;
    const H5T_class_t kind = H5Tget_class(Handle(H5Aget_type(attribute), H5Tclose));
    const hssize_t count = count_of(attribute);
    if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || count < 1 || count > most_few) return std::nullopt;
    std::vector<double> values(static_cast<size_t>(count));
    if (H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0) return std::nullopt;
    return values;
  }

 private:
  static constexpr hsize_t most_links = 10000;
  static constexpr size_t most_text = 65536;
  static constexpr hssize_t most_few = 1000;

  Handle array_at(const std::string& path) const {
    const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    H5Pset_elink_cb(access, refuse_link, nullptr);
    return {H5Dopen2(file_, path.c_str(), access), H5Dclose};
  }
  Handle group_at(const std::string& path) const {
    const Handle access(H5Pcreate(H5P_GROUP_ACCESS), H5Pclose);
    H5Pset_elink_cb(access, refuse_link, nullptr);
    return {H5Gopen2(file_, path.c_str(), access), H5Gclose};
  }
  Handle attribute_of(const std::string& group, const std::string& name) const {
    const Handle owner = group_at(group);
    return {owner.is_open() ? H5Aopen(owner, name.c_str(), H5P_DEFAULT) : hid_t{-1}, H5Aclose};
  }
  static hssize_t count_of(const Handle& attribute) {
    return H5Sget_simple_extent_npoints(Handle(H5Aget_space(attribute), H5Sclose));
  }

  static std::vector<uint64_t> sizes_of(const Handle& set) {
    if (!set.is_open()) return {};
    const Handle space(H5Dget_space(set), H5Sclose);
    const int axes = H5Sget_simple_extent_ndims(space);
    if (axes < 1 || axes > most_axes) return {};
    std::vector<hsize_t> sizes(static_cast<size_t>(axes));
    H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
    return {sizes.begin(), sizes.end()};
  }
  static bool has_numbers(const Handle& set) {
    const H5T_class_t kind = H5Tget_class(Handle(H5Dget_type(set), H5Tclose));
    return kind == H5T_FLOAT || kind == H5T_INTEGER;
  }
  // The library takes numbers for zeros that should lie in other files and are not found there.
  static bool lies_elsewhere(const Handle& set) {
    const Handle how(H5Dget_create_plist(set), H5Pclose);
    return H5Pget_layout(how) == H5D_VIRTUAL || H5Pget_external_count(how) > 0;
  }
  bool can_hold(const std::vector<uint64_t>& sizes, size_t bytes_each) const {
    hsize_t bytes_of_file = 0;
    if (H5Fget_filesize(file_, &bytes_of_file) < 0 || bytes_each == 0) return false;
    uint64_t most = bytes_of_file * greatest_ratio / bytes_each;
    for (const uint64_t size : sizes) {
      if (size == 0) return true;
      most /= size;
    }
    return most > 0;
  }
  static bool read_rows(const Handle& set, uint64_t first, Hdf5Numbers& numbers) {
    const Handle space(H5Dget_space(set), H5Sclose);
    const std::vector<hsize_t> sizes(numbers.sizes.begin(), numbers.sizes.end());
    std::vector<hsize_t> begin(sizes.size(), 0);
    begin.front() = first;
    size_t count = 1;
    for (const hsize_t size : sizes) count *= size;
    numbers.values.resize(count);
    if (count == 0) return true;
    const Handle wanted(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose);
    return H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, sizes.data(), nullptr) >= 0 &&
           H5Dread(set, H5T_NATIVE_DOUBLE, wanted, space, H5P_DEFAULT, numbers.values.data()) >= 0;
  }

  Handle file_;
};

}  // namespace

bool ombre_hdf5_write(const std::vector<Hdf5Array>* arrays, std::string* bytes) {
  const Turn turn;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_fapl_core(access, growth, false);
  H5Pset_obj_track_times(creation, false);
  const Handle file(H5Fcreate(new_name().c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  return file.is_open() &&
         std::ranges::all_of(*arrays, [&](const Hdf5Array& array) { return write_array(file, array); }) &&
         take_image(file, *bytes);
}

Hdf5File* ombre_hdf5_open(std::string_view bytes) {
  const Turn turn;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, growth, false);
  // The library copies the bytes, although it does not take them as constant.
  H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size());  // NOLINT
  const hid_t file = H5Fopen(new_name().c_str(), H5F_ACC_RDONLY, access);
  return file < 0 ? nullptr : new OpenFile(file);
}
