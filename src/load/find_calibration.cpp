#include "load/find_calibration.h"

#include "base/text/json.h"
#include "base/text/record.h"
#include "formats/containers/file.h"
#include "load/data_folder.h"
#include "load/shipped_files.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

ShippedFiles calibrations() {
  ShippedFiles files{{}, "calibration", "file", Code::unknown_object, "name"};
  const fs::path data = data_folder();
  for (const fs::path& folder : {data / "calibrations", data / "data/calibrations"})
    if (std::error_code ignored; fs::is_directory(folder, ignored)) files.folders.push_back(folder);
  return files;
}

}  // namespace

std::vector<std::string> calibration_names() { return calibrations().names(); }

calibration::CalibrationPtr find_calibration(const std::string& name_or_path, Diagnostics& diagnostics) {
  const auto path = calibrations().find(name_or_path, diagnostics);
  if (!path) return nullptr;
  const size_t known = diagnostics.list().size();
  auto calibration = calibration::parse_calibration(make_source(*path, formats::read_file(*path)), diagnostics);
  diagnostics.tell_code(known, Code::file_content, {{"file", *path}});
  if (!calibration || !calibration->inks) return calibration;
  auto found = std::make_shared<calibration::Calibration>(*calibration);
  found->inks->profile = (fs::path(*path).parent_path() / found->inks->profile).string();
  return found;
}

std::optional<std::vector<std::string>> calibrations_of_materials(const std::string& path, Diagnostics& diagnostics) {
  const std::string file = path.empty() ? data_folder() + "/materials/default.json" : path;
  const size_t known = diagnostics.list().size(), errors = diagnostics.error_count();
  const auto data = parse_json(make_source(file, formats::read_file(file)), diagnostics);
  const Data* const list = data ? data->find("calibrations") : nullptr;
  const MemberReader reader(diagnostics);
  const DataList* const items = list ? reader.list(*list, "calibrations") : nullptr;
  std::vector<std::string> names;
  for (size_t n = 0; items && n < items->size(); ++n) {
    const auto name = reader.text((*items)[n], "calibrations");
    if (name) names.push_back(is_path(*name) ? (fs::path(file).parent_path() / *name).string() : *name);
  }
  diagnostics.tell_code(known, Code::materials_file, {{"file", file}});
  return diagnostics.error_count() > errors ? std::nullopt : std::optional(std::move(names));
}

}  // namespace ombre::compile
