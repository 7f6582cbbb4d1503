// Loads the module for HDF5 when the first file is read or written.
#include "formats/containers/hdf5.h"

#include "base/system/byte_pack.h"
#include "base/system/helper_process.h"
#include "base/system/module_loader.h"
#include "base/text/error.h"

namespace ombre::formats {

const Module hdf5_library{"ombre_hdf5",  "HDF5",       "files of HDF5",
                          "libhdf5-dev", "OMBRE_HDF5", "write .vtu, or read .xdmf with its numbers as text"};

namespace {

enum class Request : uint8_t { whether_open, numbers, sizes, arrays, text, few_numbers };

// Answers a request in the child process.
std::string answer(const Hdf5File* file, const std::string& bytes) {
  ByteUnpacker in(bytes);
  const auto kind = in.get<Request>();
  const std::string path(in.get_text()), name(in.get_text());
  const auto rows = in.get<Hdf5Rows>();
  BytePacker out;
  if (kind == Request::whether_open || !file) {
    out.add(file != nullptr);
  } else if (kind == Request::numbers) {
    std::string problem;
    const auto found = file->numbers(path, problem, rows);
    out.add(found.has_value());
    out.add_text(problem);
    if (found) out.add_list(found->sizes);
    if (found) out.add_list(found->values);
  } else if (kind == Request::sizes) {
    out.add_list(file->sizes(path));
  } else if (kind == Request::arrays) {
    const std::vector<std::string> names = file->arrays_in(path);
    out.add(uint64_t{names.size()});
    for (const std::string& array : names) out.add_text(array);
  } else if (kind == Request::text) {
    const auto found = file->text(path, name);
    out.add(found.has_value());
    out.add_text(found.value_or(""));
  } else {
    const auto found = file->few_numbers(path, name);
    out.add(found.has_value());
    out.add_list(found.value_or(std::vector<double>()));
  }
  return out.take();
}

// A file that a child process reads, because damaged files may crash or hang the library.
class HelpedFile : public Hdf5File {
 public:
  explicit HelpedFile(std::string_view bytes)
      : helper_(
            [bytes, open = load_function<decltype(ombre_hdf5_open)>(hdf5_library, "ombre_hdf5_open"),
             file = std::shared_ptr<Hdf5File>()](const std::string& request) mutable {
              if (!file) file.reset(open(bytes));
              return answer(file.get(), request);
            },
            limits_for(bytes.size()), explain) {}

  bool is_open() const {
    const std::string bytes = ask(Request::whether_open, "");
    return ByteUnpacker(bytes).get<bool>();
  }

  std::optional<Hdf5Numbers> numbers(const std::string& path, std::string& problem, Hdf5Rows rows) const override {
    const std::string bytes = ask(Request::numbers, path, "", rows);
    ByteUnpacker in(bytes);
    const bool is_there = in.get<bool>();
    problem = in.get_text();
    if (!is_there) return std::nullopt;
    Hdf5Numbers found;
    found.sizes = in.get_list<uint64_t>();
    found.values = in.get_list<double>();
    return found;
  }
  std::vector<uint64_t> sizes(const std::string& path) const override {
    const std::string bytes = ask(Request::sizes, path);
    return ByteUnpacker(bytes).get_list<uint64_t>();
  }
  std::vector<std::string> arrays_in(const std::string& group) const override {
    const std::string bytes = ask(Request::arrays, group);
    ByteUnpacker in(bytes);
    std::vector<std::string> names(in.get<uint64_t>());
    for (std::string& name : names) name = in.get_text();
    return names;
  }
  std::optional<std::string> text(const std::string& group, const std::string& name) const override {
    const std::string bytes = ask(Request::text, group, name);
    ByteUnpacker in(bytes);
    const bool is_there = in.get<bool>();
    return is_there ? std::optional(std::string(in.get_text())) : std::nullopt;
  }
  std::optional<std::vector<double>> few_numbers(const std::string& group, const std::string& name) const override {
    const std::string bytes = ask(Request::few_numbers, group, name);
    ByteUnpacker in(bytes);
    const bool is_there = in.get<bool>();
    return is_there ? std::optional(in.get_list<double>()) : std::nullopt;
  }

 private:
  static HelperLimits limits_for(size_t bytes) {
    constexpr double least_seconds = 10, seconds_for_a_byte = 1e-7;
    return {least_seconds + seconds_for_a_byte * static_cast<double>(bytes), size_t{16} << 30};
  }
  static Error explain(HelperFailure failure) {
    return {Code::file_content, std::string("the file is damaged: the library of HDF5 ") +
                                    (failure == HelperFailure::crashed ? "crashes" : "takes too long") + " on it"};
  }

  std::string ask(Request kind, const std::string& path, const std::string& name = "", Hdf5Rows rows = {}) const {
    BytePacker request;
    request.add(kind);
    request.add_text(path);
    request.add_text(name);
    request.add(rows);
    return helper_.ask(request.take(), nullptr);
  }

  mutable Helper helper_;
};

}  // namespace

std::string hdf5_file(const std::vector<Hdf5Array>& arrays) {
  std::string bytes;
  if (!load_function<decltype(ombre_hdf5_write)>(hdf5_library, "ombre_hdf5_write")(&arrays, &bytes))
    throw Error(Code::memory, "HDF5 could not make the file; is there enough memory?");
  return bytes;
}

std::unique_ptr<Hdf5File> open_hdf5(std::string_view bytes) {
  auto file = std::make_unique<HelpedFile>(bytes);
  if (!file->is_open()) return nullptr;
  return file;
}

}  // namespace ombre::formats
