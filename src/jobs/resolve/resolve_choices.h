// The options of `ombre resolve`.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "jobs/common/calibration_options.h"
#include "jobs/common/job_options.h"
#include "jobs/stacks/report_options.h"

namespace ombre::compile {

struct ResolveChoices {
  DesignOptions design;
  std::vector<std::string> printers = {};
  CalibrationOptions calibrations;
  std::optional<options::Pitches> voxel;
  std::string output;
  jobs::ReportOptions report;
  WorkOptions work;

  static const options::Spec<ResolveChoices>& options() {
    using namespace options;
    static const options::Spec<ResolveChoices> spec{
        group(&ResolveChoices::design),
        options::list("--printer", &ResolveChoices::printers, kind::text,
                      "Printer profile: a name, or the path of a .json file; several are compared", "NAME"),
        group(&ResolveChoices::calibrations),
        option("--voxel", &ResolveChoices::voxel, kind::voxel,
               "Voxel size: one length, or x,y,z (default: the printer's, or as the design says); mm", "X,Y,Z"),
        option("-o,--output", &ResolveChoices::output, kind::file,
               "Write the resolved design, which other jobs take: a .json file", "FILE"),
        group(&ResolveChoices::report,
              jobs::ReportOptions::options("Write a page with the chain, the report and pictures of what is out of "
                                           "reach")),
        group(&ResolveChoices::work, WorkOptions::options("Most memory for stages of the design (default 2G)"))};
    return spec;
  }
};

}  // namespace ombre::compile
