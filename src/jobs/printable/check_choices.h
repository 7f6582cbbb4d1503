// The options of `ombre check`.
#pragma once

#include <optional>
#include <string>

#include "jobs/common/calibration_options.h"
#include "jobs/common/job_options.h"
#include "jobs/stacks/report_options.h"

namespace ombre::compile {

struct CheckChoices {
  DesignOptions design;
  SamplingOptions sampling;
  CalibrationOptions calibrations;
  std::optional<double> details_mm, overhang_degrees;
  bool each_material = false;
  std::string fix, neutral;
  std::optional<double> drop_mm3, drain_mm;
  jobs::ReportOptions report;
  WorkOptions work;

  static const options::Spec<CheckChoices>& options() {
    using namespace options;
    static const options::Spec<CheckChoices> spec{
        group(&CheckChoices::design, &CheckChoices::sampling, &CheckChoices::calibrations),
        option("--details", &CheckChoices::details_mm, kind::length,
               "Walls and gaps below this thickness fail (default: what the printer's profile says); mm", "MM"),
        option("--overhang", &CheckChoices::overhang_degrees, kind::number,
               "Layers that reach farther beyond the layer below hang over, and islands fail (default: what the\n"
               "printer's profile says); degrees from the vertical",
               "DEGREES")
            .between(1, 89),
        flag("--each-material", &CheckChoices::each_material,
             "Check the walls of each material by itself, too; mixtures of droplets fail it"),
        option("--fix", &CheckChoices::fix, kind::file,
               "Correct the voxels where one correction is well defined, and write their layers into this folder, or\n"
               ".zip archive: thin walls get the thickness of the limit, and forbidden neighbours a shell between them",
               "DIR"),
        option("--neutral", &CheckChoices::neutral, kind::text,
               "Material of such shells (default: the one material that no rule names)", "NAME")
            .needs("--fix"),
        option("--drop", &CheckChoices::drop_mm3, kind::number,
               "Remove loose bodies below this volume, too, but not the largest body; mm3", "MM3")
            .between(1e-9, 1e9)
            .needs("--fix"),
        option("--drain", &CheckChoices::drain_mm, kind::length,
               "Open each closed hollow by a straight channel of this diameter, too, where it removes least; mm", "MM")
            .needs("--fix"),
        group(&CheckChoices::report,
              jobs::ReportOptions::options("Write a page with what was found, and pictures of where",
                                           "Replace an existing report, and the job in the folder of --fix")),
        group(&CheckChoices::work,
              WorkOptions::options("Most memory for layers, and for stages of the design (default 2G)"))};
    return spec;
  }
};

}  // namespace ombre::compile
