#include "stores/stored_files.h"

#include <algorithm>
#include <filesystem>
#include <mutex>

#include "base/system/named_files.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/containers/file.h"
#include "formats/containers/mapped_file.h"
#include "formats/containers/zip_archive.h"
#include "stores/journal_folder.h"
#include "stores/open_store.h"

namespace ombre::stores {
namespace {

class FilesOfFolder final : public StoredFiles {
 public:
  explicit FilesOfFolder(std::string path) : path_(std::move(path)), names_(names_in(path_)) {}

  const std::vector<std::string>& names() const override { return names_; }
  std::string read(const std::string& name) const override {
    return formats::read_file((std::filesystem::path(path_) / name).string());
  }

 private:
  std::string path_;
  std::vector<std::string> names_;
};

// Libzip reads an archive for one thread at a time; most time goes into what is done with the bytes.
class FilesOfArchive final : public StoredFiles {
 public:
  explicit FilesOfArchive(std::string path) : path_(std::move(path)), file_(path_) {
    guarded([&] { reader_ = std::make_unique<formats::ZipReader>(path_, file_.bytes(), diagnostics_, limits); });
    names_ = reader_->names();
    std::ranges::sort(names_);
  }

  const std::vector<std::string>& names() const override { return names_; }
  std::string read(const std::string& name) const override {
    const std::lock_guard lock(mutex_);
    std::string bytes;
    guarded([&] { bytes = reader_->read(name); });
    return bytes;
  }

 private:
  // Layers are read one by one and left, so only a single one is bounded.
  static constexpr formats::ZipLimits limits{.entries = 100'000'000, .keeps_all = false};

  template <class Work>
  void guarded(const Work& work) const {
    try {
      work();
    } catch (const DesignError&) {
      throw Error(Code::file_content, std::string(trim(to_text(diagnostics_))), {{"file", path_}});
    }
  }

  std::string path_;
  formats::MappedFile file_;
  mutable Diagnostics diagnostics_;
  mutable std::mutex mutex_;
  std::unique_ptr<formats::ZipReader> reader_;
  std::vector<std::string> names_;
};

}  // namespace

StoredFilesPtr open_files(const std::string& path) {
  if (is_archive(path) && !std::filesystem::is_directory(path)) return std::make_shared<FilesOfArchive>(path);
  return std::make_shared<FilesOfFolder>(path);
}

}  // namespace ombre::stores
