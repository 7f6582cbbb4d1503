// The options of `ombre diff`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/common/job_options.h"
#include "jobs/stacks/report_options.h"

namespace ombre::compile {

struct DiffChoices {
  std::string first, second, materials;
  jobs::ReportOptions report;
  std::vector<std::string> definitions;
  std::optional<options::Pitches> voxel;
  WorkOptions work;

  static const options::Spec<DiffChoices>& options() {
    using namespace options;
    static const options::Spec<DiffChoices> spec{
        option("first", &DiffChoices::first, kind::file, "A design, or the folder or archive of a slice job", "A")
            .required(),
        option("second", &DiffChoices::second, kind::file, "Another one of these", "B").required(),
        option("--voxel", &DiffChoices::voxel, kind::voxel,
               "Voxel size of the comparison: one length, or x,y,z; mm (default: that of the stacks, the finer one if\n"
               "they differ; of two designs the finer one of their root(), or 0.1 mm)",
               "X,Y,Z"),
        option("--materials", &DiffChoices::materials, kind::file, "Materials file of designs", "FILE"),
        options::list("-D,--define", &DiffChoices::definitions, kind::text,
                      "Set a variable of designs; may be repeated", "NAME=VALUE"),
        group(&DiffChoices::report, jobs::ReportOptions::options(
                                        "Write a page with the changes and pictures of the layers that change most")),
        group(&DiffChoices::work,
              WorkOptions::options("Most memory for layers, and for stages of designs (default 2G)"))};
    return spec;
  }
};

}  // namespace ombre::compile
