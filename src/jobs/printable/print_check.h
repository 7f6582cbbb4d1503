// Runs the checks of a job over its layers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/printable/flag_pieces.h"
#include "jobs/printable/layer_windows.h"
#include "jobs/printable/print_checks.h"
#include "jobs/slice/plan.h"

namespace ombre::compile {

struct PrintFinding {
  std::string kind, text, remedy;
  bool is_error = false;
  FlagPieces pieces;  // boxes are in voxels of the job
  int64_t layer = 0;  // the layer with the most flags, and its flags; empty if flags are more than what is found
  BitLayer flags;
};

// Returns what the checks find, errors first; the plan's stages must be prepared. The result depends on neither threads
// nor memory. Throws Cancelled.
std::vector<PrintFinding> run_print_checks(const Plan& plan, const std::vector<PrintCheck>& checks,
                                           const CheckRun& run);

}  // namespace ombre::compile
