#include "sources/files_of_results.h"

#include <algorithm>
#include <filesystem>

#include "formats/containers/file.h"
#include "formats/results/result_formats.h"
#include "sources/result_border.h"

namespace ombre::sources {
namespace {

namespace fs = std::filesystem;

constexpr size_t most_files = 1000;

}  // namespace

ResultFiles::ResultFiles(const std::string& path, std::string_view bytes, uint64_t step, const Read& read)
    : folder_(fs::path(path).parent_path().string()), step_(step) {
  add(path, bytes, "", read);
}

void ResultFiles::add(const std::string& path, std::string_view bytes, const std::string& own_name, const Read& read) {
  for (const std::string& written : formats::files_named_in(path, bytes, step_, own_name)) {
    const bool is_known = std::ranges::find(files_, written, &formats::ResultsFile::written) != files_.end();
    if (is_known || files_.size() >= most_files) continue;
    const std::string named = (fs::path(folder_) / written).lexically_normal().string();
    const auto own = read(named);
    if (!own) continue;
    bytes_.push_back(own);
    files_.push_back({named, *own, written});
    add(named, *own, written, read);
  }
}

std::optional<formats::Results> read_results(const std::string& path, Diagnostics& diagnostics, uint64_t step,
                                             const std::string& values) {
  const auto bytes_of = [](const std::string& file) -> std::shared_ptr<const std::string> {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) return nullptr;
    return std::make_shared<const std::string>(formats::read_file(file));
  };
  const std::string bytes = formats::read_file(path), beside_it = values.empty() ? numbers_beside(path) : "";
  const ResultFiles named(path, bytes, step, bytes_of);
  const auto table =
      values.empty() ? bytes_of(beside_it) : std::make_shared<const std::string>(formats::read_file(values));
  formats::ResultsBeside beside{{}, named.files(), step};
  if (table) beside.values = formats::ResultsFile{values.empty() ? beside_it : values, *table};
  return formats::read_results(path, bytes, beside, diagnostics);
}

ResultFiles result_files(design::FilePath& file, uint64_t step, Loading& loading) {
  if (!formats::may_name_files(file.path)) return {file.path, "", step, nullptr};
  Key content("file and those that it names");
  content.add(file.content);
  ResultFiles files(file.path, *loading.bytes(file), step,
                    [&](const std::string& named) -> std::shared_ptr<const std::string> {
                      design::FilePath other{named, {}};
                      std::error_code ignored;
                      if (!fs::is_regular_file(named, ignored) || !loading.read_content(other)) return nullptr;
                      content.add(other.content);
                      return loading.bytes(other);
                    });
  if (!files.files().empty()) file.content = content.hash();
  return files;
}

}  // namespace ombre::sources
