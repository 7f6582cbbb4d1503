// Writes outlines of layers: one file per layer, or one for all.
#include "export/outline_files.h"

#include <unistd.h>

#include <algorithm>
#include <deque>
#include <filesystem>

#include "base/system/not_copied.h"
#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "export/output_file.h"
#include "formats/drawings/svg.h"

namespace ombre::exporting {
namespace {

namespace fs = std::filesystem;
using formats::OutlineDocument;
using formats::OutlinePolygons;

constexpr std::string_view layer_prefix = "layer_", layer_suffix = ".svg";
constexpr size_t least_digits = 4;

bool is_layer_name(std::string_view name) {
  if (!name.starts_with(layer_prefix) || !name.ends_with(layer_suffix)) return false;
  if (name.size() < layer_prefix.size() + least_digits + layer_suffix.size()) return false;
  const std::string_view digits =
      name.substr(layer_prefix.size(), name.size() - layer_prefix.size() - layer_suffix.size());
  return std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
}

std::string layer_name(uint64_t layer, uint64_t layers) {
  const std::string number = std::to_string(layer);
  const size_t digits = std::max(least_digits, std::to_string(std::max<uint64_t>(layers, 1) - 1).size());
  return std::string(layer_prefix) + std::string(digits - number.size(), '0') + number + std::string(layer_suffix);
}

std::vector<fs::path> outline_layers(const std::string& folder) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (is_layer_name(entry.path().filename().string())) found.push_back(entry.path());
  return found;
}

std::string title_of(const OutlineDocument& document, double z_mm) {
  return document.title + ", z " + format_rounded(z_mm, 6) + " mm";
}

class SvgFile : public OutlineFiles {
 public:
  SvgFile(const OutlineTarget& target, const OutlineDocument& document) : file_(target.path), document_(document) {}
  void add(double z_mm, double, const OutlinePolygons& polygons) override {
    file_.append(formats::svg_bytes(document_, title_of(document_, z_mm), polygons));
  }
  void commit() override {
    file_.close();
    file_.commit();
  }

 private:
  NewFile file_;
  const OutlineDocument& document_;
};

class CliFile : public OutlineFiles {
 public:
  CliFile(const OutlineTarget& target, const OutlineDocument& document) : file_(target.path), rules_(target.cli) {
    file_.append(formats::cli_header(document, target.layers, target.bottom_mm, rules_));
  }
  void add(double, double top_mm, const OutlinePolygons& polygons) override {
    file_.append(formats::cli_layer(top_mm, polygons, rules_, layer_++));
  }
  void commit() override {
    file_.append(formats::cli_end(rules_));
    file_.close();
    file_.commit();
  }

 private:
  NewFile file_;
  formats::CliRules rules_;
  int64_t layer_ = 0;
};

// A folder; if it did not exist before, it is removed again unless it contains something.
class NewFolder : NotCopied {
 public:
  explicit NewFolder(const std::string& path) : path_(path) {
    std::error_code error;
    is_new_ = fs::create_directories(path, error);
    if (error) throw write_error(path, error.value());
  }
  ~NewFolder() {
    if (is_new_) ::rmdir(path_.c_str());  // succeeds only if it is empty
  }

 private:
  std::string path_;
  bool is_new_ = false;
};

class SvgFolder : public OutlineFiles {
 public:
  SvgFolder(OutlineTarget target, const OutlineDocument& document)
      : target_(std::move(target)), document_(document), folder_(target_.path) {}

  void add(double z_mm, double, const OutlinePolygons& polygons) override {
    NewFile& file = files_.emplace_back((fs::path(target_.path) / layer_name(files_.size(), target_.layers)).string());
    file.append(formats::svg_bytes(document_, title_of(document_, z_mm), polygons));
    file.close();
  }

  void commit() override {
    for (const fs::path& old : outline_layers(target_.path)) remove(old);
    for (NewFile& file : files_) file.commit();
  }

 private:
  static void remove(const fs::path& old) {
    std::error_code error;
    fs::remove(old, error);
    if (error) throw write_error(old.string(), error.value());
  }

  OutlineTarget target_;
  const OutlineDocument& document_;
  NewFolder folder_;
  std::deque<NewFile> files_;
};

}  // namespace

OutlineFormat outline_format_of(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".cli") return OutlineFormat::cli;
  return ending == ".svg" ? OutlineFormat::svg : OutlineFormat::svg_folder;
}

std::unique_ptr<OutlineFiles> begin_outline_files(const OutlineTarget& target, const OutlineDocument& document) {
  switch (target.format) {
    case OutlineFormat::svg:
      return std::make_unique<SvgFile>(target, document);
    case OutlineFormat::cli:
      return std::make_unique<CliFile>(target, document);
    case OutlineFormat::svg_folder:
      break;
  }
  return std::make_unique<SvgFolder>(target, document);
}

bool has_outline_layers(const std::string& folder) { return !outline_layers(folder).empty(); }

}  // namespace ombre::exporting
