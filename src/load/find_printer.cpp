// Finds printer profiles by name or by path.
#include "load/find_printer.h"

#include <algorithm>
#include <filesystem>

#include "base/text/error.h"
#include "base/text/text.h"
#include "formats/containers/file.h"
#include "load/data_folder.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

fs::path printers_folder() { return fs::path(data_folder()) / "printers"; }

std::optional<voxel::Printer> read_printer(const std::string& path, Diagnostics& diagnostics) {
  const size_t known = diagnostics.list().size();
  auto printer = voxel::parse_printer(make_source(path, formats::read_file(path)), diagnostics);
  diagnostics.tell_code(known, Code::printer_file);
  return printer;
}

bool is_path(const std::string& text) { return text.ends_with(".json") || text.find('/') != std::string::npos; }

}  // namespace

std::vector<std::string> printer_names() {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(printers_folder(), error), end; !error && entry != end; entry.increment(error))
    if (entry->path().extension() == ".json") names.push_back(entry->path().stem().string());
  if (error)
    throw Error(Code::cannot_read, "cannot read " + printers_folder().string() + ": " + error.message(),
                {{"file", printers_folder().string()}});
  std::sort(names.begin(), names.end());
  return names;
}

std::optional<voxel::Printer> find_printer(const std::string& name_or_path, Diagnostics& diagnostics) {
  if (is_path(name_or_path)) return read_printer(name_or_path, diagnostics);
  const std::vector<std::string> names = printer_names();
  const std::string wanted = fold_name(name_or_path);
  for (const std::string& name : names)
    if (fold_name(name) == wanted) return read_printer((printers_folder() / (name + ".json")).string(), diagnostics);

  std::string hint = did_you_mean(name_or_path, names);
  hint += (hint.empty() ? "" : " ") + std::string("there are ") + join(names, ", ") +
          "; or give the path of a .json profile";
  diagnostics.error(Code::unknown_printer, {}, "there is no printer \"" + name_or_path + '"', std::move(hint),
                    {{"printer", name_or_path}});
  return std::nullopt;
}

}  // namespace ombre::compile
