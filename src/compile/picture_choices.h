// What people choose of pictures.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compile/job_options.h"
#include "compile/picture.h"

namespace ombre::compile {

struct PictureChoices {
  DesignOptions design;
  std::string output;
  std::array<int64_t, 2> size{800, 600};
  std::string view = "iso";
  std::optional<std::array<double, 2>> angles_deg;  // azimuth, elevation
  double perspective_deg = 0, zoom = 1, deform = 0;
  std::vector<CutRequest> cuts;
  std::optional<Box> box;
  std::vector<std::pair<std::string, double>> opacity;  // by the name of the material
  std::string by;
  std::optional<Interval> range;
  std::string palette;
  render::Background background;
  int samples = 2, frames = 1;
  WorkOptions work{0, 2 * usual_memory};
  std::optional<SliceView> slice;
  bool axes = false, scale_bar = false, legend = false, annotate = false;
  std::optional<Divided> outlines, names;
  std::string font;
  bool force = false;

  static const options::Spec<PictureChoices>& options();
  PictureRequest request() const;
};

}  // namespace ombre::compile
