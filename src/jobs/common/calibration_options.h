// Options by which a job resolves properties that a design asks for.
#pragma once

#include <string>
#include <vector>

#include "jobs/common/plan_options.h"
#include "options/option.h"

namespace ombre::compile {

enum class OutOfReachRule : uint8_t { error, nearest };

struct CalibrationOptions {
  std::vector<std::string> calibrations = {};
  std::vector<std::string> deciding = {};
  OutOfReachRule out_of_reach = OutOfReachRule::error;

  static const options::Spec<CalibrationOptions>& options() {
    using namespace options;
    static const options::Spec<CalibrationOptions> spec{
        options::list("--calibration", &CalibrationOptions::calibrations, kind::text,
                      "A calibration that resolves properties into materials or settings: a name, or the path of a\n"
                      ".json file; may be repeated (default: those of the printer, or else of the materials file)",
                      "NAME|FILE"),
        options::list("--deciding", &CalibrationOptions::deciding, kind::text,
                      "An attribute that decides materials and settings; may be repeated. Others are compared with\n"
                      "what these give (default: all attributes for which there is a calibration)",
                      "ATTRIBUTE"),
        choice("--out-of-reach", &CalibrationOptions::out_of_reach, {"error", "nearest"},
               "Values that no mixture reaches are an error (default), or give the nearest value that is reached",
               "error|nearest")};
    return spec;
  }

  // Makes a job with these plan options resolve properties of a design that is loaded with this materials file. Returns
  // false, and adds diagnostics, if the file's list of calibrations is wrong. Throws Error.
  bool apply(PlanOptions& plan, const std::string& materials, Diagnostics& diagnostics) const;
};

}  // namespace ombre::compile
