// What people choose of slice jobs, and of a single layer of one.
#pragma once

#include <optional>
#include <string>

#include "compile/job_options.h"

namespace ombre::compile {

struct SliceChoices {
  DesignOptions design;
  SamplingOptions sampling;
  ImageOptions images;
  std::string folder, layers;
  WorkOptions work;
  bool force = false, resume = false, dry_run = false, strict = false;
  std::string emit;

  static const options::Spec<SliceChoices>& options();
  // The folder that was chosen, or one that has the design's name.
  std::string output_folder() const;
};

// For the plan of the same choices. Throws options::WrongValue when the layers are not among the plan's.
SliceOptions slice_options(const SliceChoices& choices, const Plan& plan);

struct LayerChoices {
  DesignOptions design;
  SamplingOptions sampling;
  ImageOptions images;
  std::string output, index;
  std::optional<double> z_mm;
  std::optional<Box> box;
  WorkOptions work;
  bool force = false;

  static const options::Spec<LayerChoices>& options();
};

}  // namespace ombre::compile
