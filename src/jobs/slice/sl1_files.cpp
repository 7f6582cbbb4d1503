#include "jobs/slice/sl1_files.h"

#include <algorithm>

#include "base/text/text.h"

namespace ombre::compile {
namespace {

constexpr const char *job_settings = "config.ini", *slicer_settings = "prusaslicer.ini";

// Keys and values of an .ini file, in its order.
using Settings = std::vector<std::pair<std::string, std::string>>;

std::string ini_text(const Settings& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text.append(key).append(" = ").append(value).append("\n");
  return text;
}

// Returns what stands before the number in the names of layers.
std::string prefix_of(const voxel::NamePattern& files) {
  const std::string name = files.name(0);
  return name.substr(0, name.find_last_not_of("0123456789", name.size() - std::string_view(".png").size() - 1) + 1);
}

// Machines look for the prefix, five digits, and ".png".
bool has_five_digits(const voxel::NamePattern& files) {
  return !files.has_material() && files.name(0) == prefix_of(files) + "00000.png";
}

// Seconds of light for all layers. The first one has its own time, from which the times of the next ones fall to the
// usual one in equal steps.
double light_seconds(const voxel::Exposure& exposure, int64_t layers) {
  double seconds = 0;
  for (int64_t layer = 0; layer < layers; ++layer) {
    const double faded = std::min(1.0, static_cast<double>(layer) / (exposure.fade_layers + 1.0));
    seconds += exposure.first_seconds + faded * (exposure.seconds - exposure.first_seconds);
  }
  return seconds;
}

Settings of_job(const SliceRequest& request, double resin_mm3) {
  const voxel::Exposure& exposure = *request.exposure;
  const int64_t layers = request.lattice.count[2];
  return {{"action", "print"},
          {"expTime", format_number(exposure.seconds)},
          {"expTimeFirst", format_number(exposure.first_seconds)},
          {"expUserProfile", "0"},
          {"jobDir", prefix_of(request.files)},
          {"layerHeight", format_number(request.lattice.pitch[2].mm())},
          {"numFade", std::to_string(exposure.fade_layers)},
          {"numFast", std::to_string(layers)},
          {"numSlow", "0"},
          {"printTime", format_rounded(light_seconds(exposure, layers), 6)},
          {"printerModel", request.printer},
          {"usedMaterial", format_rounded(resin_mm3 / 1000)}};
}

Settings of_slicer(const SliceRequest& request) {
  const voxel::Lattice& lattice = request.lattice;
  const auto side = [&](size_t axis) {
    return format_rounded(lattice.pitch[axis].times(static_cast<double>(lattice.count[axis])), 6);
  };
  const std::string height = format_number(lattice.pitch[2].mm());
  return {{"display_height", side(1)},
          {"display_mirror_x", request.flip_x ? "1" : "0"},
          {"display_mirror_y", request.flip_y ? "1" : "0"},
          {"display_orientation", "landscape"},
          {"display_pixels_x", std::to_string(lattice.count[0])},
          {"display_pixels_y", std::to_string(lattice.count[1])},
          {"display_width", side(0)},
          {"exposure_time", format_number(request.exposure->seconds)},
          {"faded_layers", std::to_string(request.exposure->fade_layers)},
          {"gamma_correction", "1"},
          {"initial_exposure_time", format_number(request.exposure->first_seconds)},
          {"initial_layer_height", height},
          {"layer_height", height},
          {"printer_technology", "SLA"}};
}

}  // namespace

void check_sl1(const SliceRequest& request, const SourceRange& where, Diagnostics& diagnostics) {
  if (!request.exposure)
    diagnostics.error(Code::option, where,
                      "the profile \"" + request.printer + "\" has no exposure, which an .sl1 archive needs",
                      "choose " + spelled::option("--printer", "prusa-sl1") + ", or a profile with \"exposure\"");
  if (!has_five_digits(request.files))
    diagnostics.error(Code::option, where,
                      "layers are named " + request.files.text() +
                          ", and an .sl1 archive has one image for each layer, " + "whose number has five digits",
                      R"(write "files": "layer{index:05}.png" in the profile)");
}

std::vector<std::pair<std::string, std::string>> sl1_files(const SliceRequest& request, double resin_mm3) {
  return {{job_settings, ini_text(of_job(request, resin_mm3))}, {slicer_settings, ini_text(of_slicer(request))}};
}

bool is_sl1_file(std::string_view name) { return name == job_settings || name == slicer_settings; }

}  // namespace ombre::compile
