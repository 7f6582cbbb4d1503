// Corrects what checks of a job find, and writes the corrected layers.
#pragma once

#include <string>
#include <vector>

#include "jobs/printable/corrections.h"
#include "jobs/printable/print_check.h"

namespace ombre::compile {

// The rules say what is corrected, and how.
struct FixRules {
  double thick_mm = 0;        // walls become as thick as this; 0: they stay
  double drop_below_mm3 = 0;  // loose bodies below this volume are removed; 0: none
  MaterialId support = 0;
  double drain_mm = 0;     // closed hollows get a channel of this diameter; 0: none
  MaterialId neutral = 0;  // keeps forbidden neighbours apart; 0: they stay
  bool may_grow = true;    // the lattice may grow
};

struct Correction {
  std::string kind, text;                // "thicken", "drop", "keep-apart" or "drain", and a sentence's beginning
  std::map<MaterialId, int64_t> gained;  // voxels of each material, less those that it loses
};

struct CorrectedJob {
  Plan plan;  // gives whole layers only
  std::vector<Correction> corrections;
  uint64_t hollows_left = 0;  // from which no straight line along an axis leads outside
};

// Applies the rules to a job, one after the other. The plan's stages must be prepared.
CorrectedJob correct_job(const Plan& plan, const std::vector<PrintCheck>& checks, const FixRules& rules,
                         const CheckRun& run);

}  // namespace ombre::compile
