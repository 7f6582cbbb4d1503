// The contents of a slicer's project besides its bodies.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/images/rgba.h"

namespace ombre::formats {

// Settings with PrusaSlicer's keys, such as fill_density = 15%.
using Settings = std::vector<std::pair<std::string, std::string>>;

struct Filament {
  std::string name;
  Rgba colour{128, 128, 128, 255};
  std::optional<double> temperature = {};  // of the nozzle, in degrees Celsius
  std::optional<double> flow = {};         // factor on what the nozzle extrudes
};

// A filament that slicers make of others by changing from layer to layer.
struct FilamentMixture {
  struct Part {
    uint32_t extruder = 1;  // number of a filament, from 1
    int layers = 1;         // layers of a cycle
  };
  std::string name;
  Rgba colour{128, 128, 128, 255};
  std::vector<Part> parts;
};

// Settings for layers within a range of heights, which are counted from the lowest point of all bodies.
struct HeightRange {
  double from_mm = 0, to_mm = 0;
  Settings settings;
};

// Bodies name filaments by their setting "extruder": 1 is the first filament, and mixtures follow the filaments.
struct SlicerProject {
  std::vector<Filament> filaments = {};        // empty: one for each extruder of the bodies (project_filaments.h)
  std::vector<FilamentMixture> mixtures = {};  // only with filaments
  std::vector<HeightRange> ranges = {};
  Settings object_settings = {};  // settings of the whole, which bodies cannot have
  bool has_one_nozzle = false;    // filaments are settings of one nozzle, which tool changes set
};

}  // namespace ombre::formats
