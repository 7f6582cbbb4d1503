// The options of homogenisation.
#pragma once

#include <optional>
#include <string>

#include "jobs/common/job_options.h"
#include "jobs/fea/section_options.h"

namespace ombre::compile {

struct HomogeniseChoices {
  DesignOptions design;
  double cell_mm = 0;
  std::optional<Box> box;
  std::string study;
  double density = 0;  // 0: not chosen
  std::string by;
  SectionOptions sections;
  uint64_t seed = 0;
  std::string output;
  double tolerance = 1e-6;
  WorkOptions work{0, 4 * usual_memory};
  bool force = false;

  static const options::Spec<HomogeniseChoices>& options() {
    using namespace options;
    using H = HomogeniseChoices;
    static const options::Spec<H> spec{
        group(&H::design),
        option("--cell", &H::cell_mm, kind::number, "Approximate size of bricks, mm", "MM")
            .required()
            .between(1e-6, 1e6),
        option("--box", &H::box, kind::box, "The box that repeats, mm (default: that of the design)",
               "X0,Y0,Z0,X1,Y1,Z1"),
        option("--study", &H::study, kind::file, "Properties of materials; a .json file", "FILE"),
        option("--density", &H::density, kind::number,
               "Share of the box that is to be solid: a variable of the design is changed until it is", "X")
            .between(1e-6, 1),
        option("--by", &H::by, kind::text, "The variable for --density, and the range of its values", "NAME=LOW:HIGH"),
        group(&H::sections),
        option("--seed", &H::seed, kind::seed, "Seed of draw (default 0)", "N"),
        option("-o,--output", &H::output, kind::file, "A chart of Young's modulus by direction, .svg", "FILE"),
        option("--tolerance", &H::tolerance, kind::number, "Greatest imbalance of forces, as a share (default 1e-6)",
               "X")
            .between(1e-12, 0.1),
        group(&H::work, WorkOptions::options("Most memory for solving (default 8G)")),
        flag("--force", &H::force, "Replace an existing file")};
    return spec;
  }
};

}  // namespace ombre::compile
