// Compares the properties that a design asks for with those that a job gives.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "calibration/calibration.h"
#include "jobs/resolve/colour_intent.h"
#include "load/resolved.h"
#include "stages/job_stages.h"
#include "voxel/lattice.h"

namespace ombre::compile {

// An attribute, and what calibrations expect of the part in its place. Means are over the part's volume.
struct Intent {
  std::string attribute, unit;
  std::string by;           // the calibration that predicts it; empty: nothing does
  bool is_setting = false;  // the machine takes the attribute as it is
  double mean_wanted = 0, mean_given = 0;
  double mean_miss = 0;                      // mean of the absolute difference
  double worst_wanted = 0, worst_given = 0;  // where the difference is greatest
  Vec3 worst_mm;
  std::optional<double> share_out_of_reach;  // of the volume; nothing: the attribute decides nothing
  std::optional<double> spread;              // mean of the expected standard deviation
};

struct IntentReport {
  std::vector<Intent> intents = {};
  voxel::Lattice lattice = {};             // of the points that were looked at
  uint64_t points = 0;                     // inside
  std::vector<uint8_t> flags = {};         // of each point of the lattice: 0 outside, 1 inside, 2 inside, out of reach
  std::vector<ColourIntent> colours = {};  // of each calibration of inks
  std::vector<uint8_t> colour_flags =
      {};  // as flags, 2 where a colour is out of gamut; empty without such calibrations
  std::vector<std::string> unknown_colours = {};  // attributes that no calibration of inks judges
};

struct IntentQuery {
  const Resolution& resolution;
  std::vector<calibration::CalibrationPtr> calibrations;  // those that may predict
  std::vector<std::string> needs;                         // what the printer takes
  StageLoan loan = {};                                    // threads and memory, and what stops the survey
};

// Returns a lattice over the middle of the job's box, whose cells are whole numbers of its voxels, with a limited
// number of points.
voxel::Lattice coarse_lattice(const voxel::Lattice& job);

// Compares what `design` asks for with what its resolved form gives, at points of the lattice. Returns nothing, and
// adds diagnostics, if the design is too large. Throws Cancelled.
std::optional<IntentReport> survey_intent(const design::Design& design, const IntentQuery& query,
                                          const voxel::Lattice& lattice, Diagnostics& diagnostics);

}  // namespace ombre::compile
