// The options of `ombre contours`.
#pragma once

#include <optional>
#include <string>

#include "jobs/common/job_options.h"
#include "jobs/common/region_options.h"
#include "jobs/outline/contour_job.h"

namespace ombre::compile {

struct ContourChoices {
  DesignOptions design;
  std::string output;
  std::optional<Pitch> layer_height;
  std::optional<double> z_mm;
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
        group(&ContourChoices::work, WorkOptions::options("Most memory for layers in flight and stages (default 2G)")),
        flag("--force", &ContourChoices::force, "Replace existing files")};
    return spec;
  }
  ContourRequest request() const;
};

}  // namespace ombre::compile
