// What people choose of jobs that cut a design into regions: outlines of layers, and meshes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/contour_job.h"
#include "compile/job_options.h"
#include "compile/mesh_job.h"
#include "formats/mesh_writers.h"

namespace ombre::compile {

struct RegionOptions {
  std::optional<double> tolerance_mm, cell_mm;
  std::string by;
  int bands = 0;  // 0: not chosen
  std::vector<double> borders;

  // `piece` is what a region becomes: "A body".
  static options::Spec<RegionOptions> options(const std::string& piece);
  // Throws options::WrongValue for what does not go together.
  RegionRequest request() const;
};

struct ContourChoices {
  DesignOptions design;
  std::string output;
  std::optional<Pitch> layer_height;
  std::optional<double> z_mm;
  RegionOptions regions;
  WorkOptions work;
  bool force = false;

  static const options::Spec<ContourChoices>& options();
  ContourRequest request() const;
};

struct MeshChoices {
  DesignOptions design;
  std::string output;
  RegionOptions regions;
  std::string colour_by, palette;
  std::optional<Interval> range;
  bool keep_all = false;
  formats::SlicerFlavour flavour = formats::SlicerFlavour::generic;
  std::vector<std::string> settings;
  bool beams = false;
  WorkOptions work{0, 2 * usual_memory};
  bool force = false;

  static const options::Spec<MeshChoices>& options();
  MeshRequest request() const;
};

}  // namespace ombre::compile
