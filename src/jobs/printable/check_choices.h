// The options of `ombre check`.
#pragma once

#include <optional>
#include <string>

#include "jobs/common/job_options.h"
#include "jobs/stacks/report_options.h"

namespace ombre::compile {

struct CheckChoices {
  DesignOptions design;
  SamplingOptions sampling;
  std::optional<double> details_mm;
  bool each_material = false;
  jobs::ReportOptions report;
  WorkOptions work;

  static const options::Spec<CheckChoices>& options() {
    using namespace options;
    static const options::Spec<CheckChoices> spec{
        group(&CheckChoices::design),
        group(&CheckChoices::sampling),
        option("--details", &CheckChoices::details_mm, kind::length,
               "Walls and gaps below this thickness fail (default: what the printer's profile says); mm", "MM"),
        flag("--each-material", &CheckChoices::each_material,
             "Check the walls of each material by itself, too; mixtures of droplets fail it"),
        group(&CheckChoices::report,
              jobs::ReportOptions::options("Write a page with what was found, and pictures of where")),
        group(&CheckChoices::work,
              WorkOptions::options("Most memory for layers, and for stages of the design (default 2G)"))};
    return spec;
  }
};

}  // namespace ombre::compile
