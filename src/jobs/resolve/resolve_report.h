// Reports how a design's properties are resolved for printers, and what the printers give.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jobs/common/events.h"
#include "jobs/resolve/cure_survey.h"
#include "jobs/resolve/intent.h"

namespace ombre::jobs {

// A design on one printer.
struct ResolvedPart {
  std::string printer, title;
  std::string problem;  // why it cannot be resolved; then the rest is empty
  compile::Resolution resolution;
  compile::IntentReport report;
  std::optional<compile::CureReport> cure = {};  // of a vat printer with a working curve
};

// True if all of the part is within reach.
bool is_reached(const ResolvedPart& part);

void tell_resolved(const Events& events, const std::vector<ResolvedPart>& parts);
// Returns a page in HTML with the chains, the table, and a picture of a layer with what is out of reach.
std::string resolved_page(const std::string& design, const std::vector<ResolvedPart>& parts);

}  // namespace ombre::jobs
