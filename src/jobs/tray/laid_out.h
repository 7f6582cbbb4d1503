// Lays copies of designs out on a tray, as one design.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "load/loaded.h"
#include "voxel/printer.h"

namespace ombre::compile {

// A design, and how many copies of it a tray has.
struct TrayItem {
  std::string name;  // copies are called knob_1, knob_2, ...
  LoadedPtr loaded;
  int64_t count = 1;
};

// A design file, since nodes of several designs in memory hold materials of their own.
struct TrayDesign {
  Data file;
  std::vector<std::string> parts;  // their names
};

// Returns the design with all copies: each stands on z = 0, at a whole number of voxels from the tray's corner, with
// the gap between its box and others. Returns nothing, and adds diagnostics, if a part is too high or has no bounds, if
// materials differ, or if not all copies fit.
std::optional<TrayDesign> laid_out(const std::vector<TrayItem>& items, const voxel::Printer& printer, double gap_mm,
                                   Diagnostics& diagnostics);

}  // namespace ombre::compile
