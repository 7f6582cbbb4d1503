// Reports what checks of a job find.
#pragma once

#include <string>
#include <vector>

#include "jobs/common/events.h"
#include "jobs/printable/fix_job.h"
#include "jobs/printable/print_check.h"

namespace ombre::jobs {

struct CheckedPart {
  std::string design, printer;
  std::vector<compile::PrintFinding> findings;
  std::vector<std::string> unchecked;  // what was not looked at, a sentence each
};

// Says what was corrected, with the volume that each material gains or loses.
void tell_corrections(const Events& events, const std::vector<compile::Correction>& corrections,
                      const compile::SliceRequest& request);
// Describes corrections for programs and for job.json.
DataList describe(const std::vector<compile::Correction>& corrections, const compile::SliceRequest& request);

void tell_findings(const Events& events, const CheckedPart& part, const voxel::Lattice& lattice);
// Returns a page in HTML with a picture of each finding.
std::string findings_page(const CheckedPart& part, const compile::Plan& plan, const StopFlag* stop);

}  // namespace ombre::jobs
