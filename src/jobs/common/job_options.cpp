#include "jobs/common/job_options.h"

#include "load/find_printer.h"

namespace ombre::compile {

LoadOptions DesignOptions::load() const {
  LoadOptions options{materials, definitions};
  options.material_map = material_map;
  options.needed = needed;
  return options;
}

std::optional<PlanOptions> plan_options(const std::string& program, const SamplingOptions& sampling,
                                        const ImageOptions& images, Diagnostics& diagnostics) {
  const auto printer = find_printer(sampling.printer.empty() ? "generic" : sampling.printer, diagnostics);
  if (!printer) return std::nullopt;
  PlanOptions options;
  options.program = program;
  options.printer = *printer;
  options.printer_given = !sampling.printer.empty();
  if (sampling.voxel) options.pitch = *sampling.voxel;
  if (sampling.dpi) options.pitch = *sampling.dpi;
  if (sampling.layer_height) options.pitch[2] = *sampling.layer_height;
  static_cast<SamplingRules&>(options) = sampling.rules;
  options.image = images.format;
  options.place = sampling.place;
  options.whole_tray = sampling.tray;
  if (images.samples > 0) options.value = ValueChoice{"coverage", {}, 8, images.samples};
  if (!images.by.empty()) options.value = ValueChoice{images.by, images.range, std::stoi(images.bits)};
  return options;
}

}  // namespace ombre::compile
