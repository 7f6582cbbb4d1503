// The options of `ombre characterise`.
#pragma once

#include <optional>
#include <string>

#include "jobs/common/job_options.h"

namespace ombre::compile {

struct CharacteriseChoices {
  DesignOptions design;
  double voxel_mm = 0;
  std::optional<Box> box;
  std::string periodic;  // some of x, y and z
  bool stiffness = false;
  std::string study;
  std::optional<double> cell_mm;
  std::string sweep, key;
  std::string picture, output;
  WorkOptions work;
  bool force = false;

  static const options::Spec<CharacteriseChoices>& options() {
    using namespace options;
    using C = CharacteriseChoices;
    static const options::Spec<C> spec{
        group(&C::design),
        option("--voxel", &C::voxel_mm, kind::number, "Size of the voxels, mm; voxels of twice the size give the error",
               "MM")
            .required()
            .between(1e-6, 1e6),
        option("--box", &C::box, kind::box, "The box that counts, mm (default: that of the design)",
               "X0,Y0,Z0,X1,Y1,Z1"),
        option("--periodic", &C::periodic, kind::text,
               "Axes along which the box repeats without end, such as xyz; its faces there are no surface", "AXES"),
        flag("--stiffness", &C::stiffness, "Homogenise the box, too, as ombre homogenise does"),
        option("--study", &C::study, kind::file, "Properties of materials for the stiffness; a .json file", "FILE")
            .needs("--stiffness"),
        option("--cell", &C::cell_mm, kind::number,
               "Approximate size of the bricks for the stiffness, mm (default: about the voxels')", "MM")
            .between(1e-6, 1e6)
            .needs("--stiffness"),
        option("--picture", &C::picture, kind::file, "A chart of Young's modulus by direction, .svg", "FILE")
            .needs("--stiffness")
            .excludes({"--sweep"}),
        option("--sweep", &C::sweep, kind::text,
               "A curve: values of a variable of the design, from LOW to HIGH in N steps of equal length",
               "NAME=LOW..HIGH:N")
            .needs("-o"),
        option("--key", &C::key, kind::text,
               "The column that comes first in the table, and by which its rows are sorted, such as density (default: "
               "the variable)",
               "COLUMN")
            .needs("--sweep"),
        option("-o,--output", &C::output, kind::file,
               "A table of the curve, .csv, which the node table reads; or all numbers, .json", "FILE"),
        group(&C::work, WorkOptions::options("Most memory for the surface, and for stages of the design (default 2G)")),
        flag("--force", &C::force, "Replace an existing file")};
    return spec;
  }
};

}  // namespace ombre::compile
