// Adds up the light that reaches each place of a vat printer's part.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "calibration/calibration.h"
#include "design/design.h"
#include "stages/job_stages.h"
#include "voxel/lattice.h"

namespace ombre::compile {

// The volume that doses of light cure, by a working curve (P. F. Jacobs, Rapid Prototyping & Manufacturing, 1992).
// Light comes from above, falls to 1/e within the penetration depth, and cures a place once all layers together have
// brought the critical dose there. Volumes are in mm3, lengths in mm.
struct CureReport {
  std::string by;          // the calibration
  double under_mm3 = 0;    // of the part that stays below the critical dose
  double under_share = 0;  // of the part's volume
  double least_depth = 0;  // to which a layer of the part is cured at the worst place, from its top
  Vec3 least_mm;           // that place
  double over_mm3 = 0;     // outside the part that is cured, too: below overhangs
  double deepest = 0;      // how far it reaches below the part
  Vec3 deepest_mm;         // where
  double layer_mm = 0;
};

// Returns the calibration that is a working curve from doses to the cured depth, if there is one.
const calibration::Calibration* working_curve_among(const std::vector<calibration::CalibrationPtr>& calibrations);

// Follows the light through all layers of the lattice in each of its columns. The design must give a dose. Returns
// nothing, and adds diagnostics, if the design is too large. Throws Cancelled.
std::optional<CureReport> survey_cure(const design::Design& design, const calibration::Calibration& curve,
                                      const voxel::Lattice& lattice, const StageLoan& loan, Diagnostics& diagnostics);

// Returns the lattice with columns that are so many voxels apart that it has a limited number of points; its layers
// stay.
voxel::Lattice columns_of(const voxel::Lattice& job);

}  // namespace ombre::compile
