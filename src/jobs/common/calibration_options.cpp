#include "jobs/common/calibration_options.h"

#include "load/find_calibration.h"

namespace ombre::compile {

bool CalibrationOptions::apply(PlanOptions& plan, const std::string& materials, Diagnostics& diagnostics) const {
  CalibrationNames names{calibrations, plan.printer.calibrations};
  if (names.chosen.empty() && names.listed.empty()) {
    const auto of_materials = calibrations_of_materials(materials, diagnostics);
    if (!of_materials) return false;
    names.listed = *of_materials;
  }
  plan.resolving = Resolving{std::move(names), deciding, out_of_reach == OutOfReachRule::nearest};
  return true;
}

}  // namespace ombre::compile
