#include "studio/bundles.h"

#include <algorithm>
#include <filesystem>

#include "base/system/temporary_folder.h"
#include "base/text/text.h"
#include "formats/containers/base64.h"
#include "formats/containers/file.h"
#include "load/bundle.h"
#include "load/data_folder.h"
#include "studio/designs.h"

namespace ombre::studio {
namespace {

namespace fs = std::filesystem;

constexpr const char* example_ending = ".vcad";

struct MadeBundle {
  compile::BundleContents contents;
  std::string bytes;
};

MadeBundle make_bundle(const fs::path& design, const StopFlag& stop) {
  const TemporaryFolder folder;
  const std::string path = folder.file("made.ombre");
  compile::LoadOptions options;
  options.stop = &stop;
  Diagnostics diagnostics;
  auto contents = compile::write_bundle(design.string(), path, options, diagnostics);
  if (!contents) throw design_error(diagnostics);
  return {std::move(*contents), formats::read_file(path)};
}

// Returns a folder that does not exist yet, with that name or with a number appended.
fs::path new_folder(const Workspace& workspace, const std::string& name) {
  constexpr int most_copies = 1000;
  fs::path folder = workspace.path(name);
  for (int copy = 2; fs::exists(folder); ++copy) {
    if (copy > most_copies) throw RequestError("name", "there are too many folders called " + name);
    folder = workspace.path(name + "_" + std::to_string(copy));
  }
  return folder;
}

// Unpacks a bundle and returns the name of its design in the workspace.
std::string unpack(const Workspace& workspace, const std::string& name, std::string_view bytes) {
  const fs::path folder = new_folder(workspace, fs::path(name).stem().string());
  try {
    Diagnostics diagnostics;
    const auto unpacked = compile::unpack_bundle(name, bytes, folder, diagnostics);
    if (!unpacked) throw design_error(diagnostics);
    return workspace.name_of(unpacked->design);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    throw;
  }
}

fs::path examples_folder() { return fs::path(compile::data_folder()) / "examples"; }

// Returns a script's first line without slashes, such as "A knob for a 6 mm shaft, ..."
std::string first_sentence(const fs::path& file) {
  const std::string text = formats::read_file(file.string());
  if (!text.starts_with("//")) return "";
  return std::string(trim(std::string_view(text).substr(2, text.find('\n') - 2)));
}

}  // namespace

Answer bundle_answer(const Workspace& workspace, const Request& request, const StopFlag& stop) {
  const std::string& file = request.text("file");
  if (to_lower(file).ends_with(".py"))
    throw RequestError("unsupported", "Python scripts may read anything, so they make no bundle");
  MadeBundle made = make_bundle(workspace.path(file), stop);
  const auto list = [](const std::vector<std::string>& names) { return DataList(names.begin(), names.end()); };
  return {{{"files", list(made.contents.files)}, {"left_outside", list(made.contents.left_outside)}},
          std::move(made.bytes)};
}

Answer unbundle_answer(const Workspace& workspace, const Request& request, const StopFlag&) {
  const auto bytes = formats::from_base64(request.text("bytes"));
  if (!bytes) throw RequestError("request", "\"bytes\" is the bundle in base64");
  return {{{"file", unpack(workspace, request.text("name"), *bytes)}}, {}};
}

Answer examples_answer(const Workspace&, const Request&, const StopFlag&) {
  std::vector<std::pair<std::string, std::string>> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(examples_folder(), error))
    if (entry.path().extension() == example_ending)
      found.emplace_back(entry.path().stem().string(), first_sentence(entry.path()));
  std::ranges::sort(found);
  DataList list;
  for (const auto& [name, sentence] : found) list.emplace_back(DataMembers{{"name", name}, {"sentence", sentence}});
  return {{{"examples", std::move(list)}}, {}};
}

Answer open_example_answer(const Workspace& workspace, const Request& request, const StopFlag& stop) {
  const std::string& name = request.text("name");
  const fs::path file = examples_folder() / (name + example_ending);
  if (name.find('/') != std::string::npos || !fs::is_regular_file(file))
    throw RequestError("name", "there is no example called " + name);
  return {{{"file", unpack(workspace, name + ".ombre", make_bundle(file, stop).bytes)}}, {}};
}

Answer example_picture_answer(const Workspace&, const Request& request, const StopFlag&) {
  const std::string& name = request.text("name");
  const fs::path file = examples_folder() / "pictures" / (name + ".png");
  std::error_code ignored;
  if (name.find('/') != std::string::npos || !fs::is_regular_file(file, ignored)) return {};
  return {{{"type", "image/png"}}, formats::read_file(file.string())};
}

}  // namespace ombre::studio
