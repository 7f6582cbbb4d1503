// The options of searches for the best design.
#pragma once

#include <string>

#include "jobs/common/job_options.h"

namespace ombre::compile {

struct OptimiseChoices {
  DesignOptions design;
  std::string study, folder;
  bool force = false, resume = false;
  int best = 10;
  WorkOptions work{0, 4 * usual_memory};

  static const options::Spec<OptimiseChoices>& options() {
    using namespace options;
    using O = OptimiseChoices;
    static const options::Spec<O> spec{
        group(&O::design),
        option("--study", &O::study, kind::file,
               "The study: variables, objectives, constraints; or topology; a .json file", "FILE")
            .required(),
        option("-o,--output", &O::folder, kind::file, "The folder for the results", "FOLDER").required(),
        flag("--force", &O::force, "Begin again in a folder that has a history"),
        flag("--resume", &O::resume, "Go on with the history in the folder").excludes({"--force"}),
        option("--best", &O::best, kind::whole,
               "Greatest number of best designs that are written as scripts (default 10)", "N")
            .between(1, 10000),
        group(&O::work, WorkOptions::options("Most memory for solving several designs at once (default 8G)"))};
    return spec;
  }
};

}  // namespace ombre::compile
