// Finds printer profiles by name or by path.
#include "load/find_printer.h"

#include "formats/containers/file.h"
#include "load/data_folder.h"
#include "load/shipped_files.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

ShippedFiles profiles() {
  return {{fs::path(data_folder()) / "printers"}, "printer", "profile", Code::unknown_printer, "printer"};
}

}  // namespace

std::vector<std::string> printer_names() { return profiles().names(); }

std::optional<voxel::Printer> find_printer(const std::string& name_or_path, Diagnostics& diagnostics) {
  const auto path = profiles().find(name_or_path, diagnostics);
  if (!path) return std::nullopt;
  const size_t known = diagnostics.list().size();
  auto printer = voxel::parse_printer(make_source(*path, formats::read_file(*path)), diagnostics);
  diagnostics.tell_code(known, Code::printer_file);
  if (printer)
    for (std::string& calibration : printer->calibrations)
      if (is_path(calibration)) calibration = (fs::path(*path).parent_path() / calibration).string();
  return printer;
}

}  // namespace ombre::compile
