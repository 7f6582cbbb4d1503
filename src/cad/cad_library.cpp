// Loads the module for CAD files when the first is read.
#include "cad/solids.h"

#include <algorithm>

#include "base/system/module_loader.h"
#include "cad/occt_calls.h"

namespace ombre::cad {
namespace {

constexpr Module opencascade{"ombre_opencascade",         "Open CASCADE", "CAD files",
                             "libocct-data-exchange-dev", "OMBRE_CAD",    "save the part as a mesh (STL, 3MF)"};

}  // namespace

std::vector<FileFormat> file_formats() {
  constexpr std::string_view refused = "files without a solid; surfaces that do not close";
  constexpr std::string_view left_out = "wires; points; dimensions; surfaces beside solids";
  return {{"STEP", {".step", ".stp"}, Content::cad, true, false, &opencascade, refused, left_out},
          {"IGES", {".iges", ".igs"}, Content::cad, true, false, &opencascade, refused, left_out},
          {"Open CASCADE", {".brep", ".brp"}, Content::cad, true, false, &opencascade, refused, left_out}};
}

bool is_cad_file(const std::string& path) {
  return std::ranges::any_of(file_formats(), [&](const FileFormat& format) { return has_ending(path, format); });
}

std::vector<SolidPtr> read_solids(const std::string& path, const StopFlag* stop) {
  static const auto read = load_function<decltype(ombre_read_cad)>(opencascade, "ombre_read_cad");
  std::vector<SolidPtr> solids;
  read(&path, stop, &solids);
  return solids;
}

}  // namespace ombre::cad
