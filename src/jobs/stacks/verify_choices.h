// The options of `ombre verify`.
#pragma once

#include <optional>
#include <string>

#include "jobs/common/job_options.h"
#include "jobs/stacks/report_options.h"

namespace ombre::compile {

// Returns options of a design that need not be given, under another name than a positional argument.
inline options::Spec<DesignOptions> optional_design() {
  options::Row<DesignOptions> row{DesignOptions::options().options()};
  for (options::Option& option : row.options) {
    if (option.is_required)
      option.names = "--design";
    else
      option.needs = {"--design"};
    option.is_required = false;
  }
  return {row};
}

struct VerifyChoices {
  std::string stack, layers, plan;
  jobs::ReportOptions report;
  DesignOptions design;
  std::optional<double> voxels;
  uint64_t seed = 0;
  WorkOptions work;
  bool all = false;

  static const options::Spec<VerifyChoices>& options() {
    using namespace options;
    static const options::Spec<VerifyChoices> spec{
        option("stack", &VerifyChoices::stack, kind::file, "Folder or .zip archive of a slice job", "STACK").required(),
        option("--layers", &VerifyChoices::layers, kind::text,
               "Look at these layers alone: a:b as in Python (b excluded), a:, :b or a", "A:B"),
        group(&VerifyChoices::design, optional_design()),
        option("--voxels", &VerifyChoices::voxels, kind::number,
               "The most voxels that are evaluated again, layers at borders of shares apart (default 2e7)", "N")
            .needs("--design")
            .between(1, 1e15),
        flag("--all", &VerifyChoices::all, "Evaluate all voxels again").needs("--design").excludes({"--voxels"}),
        option("--seed", &VerifyChoices::seed, kind::seed,
               "Seed of the choice of voxels that are evaluated again (default 0)", "N")
            .needs("--design"),
        option("--plan", &VerifyChoices::plan, kind::file,
               "The plan by which the job was shared out: layers at the borders of shares are evaluated again in full",
               "PLAN")
            .needs("--design"),
        group(&VerifyChoices::report,
              jobs::ReportOptions::options("Write a page with what was found, and pictures of where")),
        group(&VerifyChoices::work,
              WorkOptions::options("Most memory for layers, and for stages of the design (default 2G)"))};
    return spec;
  }
};

}  // namespace ombre::compile
