// The options of `ombre contours`.
#pragma once

#include <optional>
#include <string>

#include "formats/drawings/cli.h"
#include "jobs/common/job_options.h"
#include "jobs/common/region_options.h"
#include "jobs/outline/contour_job.h"

namespace ombre::compile {

struct ContourChoices {
  DesignOptions design;
  std::string output;
  std::optional<Pitch> layer_height;
  std::optional<double> z_mm, hatch_mm;
  double hatch_angle = 0, hatch_turn = 67;  // degrees
  bool binary = false;
  RegionOptions regions;
  WorkOptions work;
  bool force = false;

  static const options::Spec<ContourChoices>& options() {
    using namespace options;
    static const options::Spec<ContourChoices> spec{
        group(&ContourChoices::design),
        option("-o,--output", &ContourChoices::output, kind::file,
               "The folder or file to write; the ending of a file decides its format", "FOLDER|FILE")
            .required(),
        option("--layer-height", &ContourChoices::layer_height, kind::layer_height,
               "Height of layers; mm (default: the design's own, else 0.1)", "MM"),
        option("--z", &ContourChoices::z_mm, kind::height, "Write only the layer at this height; mm", "MM"),
        group(&ContourChoices::regions,
              RegionOptions::options("An outline", "whole", "a thousandth of its longest side")),
        option("--hatch", &ContourChoices::hatch_mm, kind::length,
               "Fill regions with parallel lines at this distance, in .cli files; mm", "MM"),
        option("--hatch-angle", &ContourChoices::hatch_angle, kind::number,
               "Angle of the lines of the first layer, from x towards y; degrees (default 0)", "DEGREES")
            .between(-360, 360)
            .needs("--hatch"),
        option("--hatch-turn", &ContourChoices::hatch_turn, kind::number,
               "Turn of the lines from one layer to the next; degrees (default 67)", "DEGREES")
            .between(-360, 360)
            .needs("--hatch"),
        flag("--binary", &ContourChoices::binary, "Write the .cli file with binary numbers of 32 bits"),
        group(&ContourChoices::work, WorkOptions::options("Most memory for layers in flight and stages (default 2G)")),
        flag("--force", &ContourChoices::force, "Replace existing files")};
    return spec;
  }
  ContourRequest request() const;
  formats::CliRules cli() const;
};

}  // namespace ombre::compile
