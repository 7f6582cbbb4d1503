// The report of a search: its best designs as scripts, a table and a chart.
#pragma once

#include <string>

#include "jobs/common/events.h"
#include "jobs/optimise/optimise_choices.h"
#include "jobs/optimise/search_history.h"

namespace ombre::jobs {

// Returns "width = 2, ribs = 3".
std::string values_text(const compile::OptimiseStudy& study, const compile::History::Row& row);
// Writes the best designs into the folder of the search. Returns an exit code.
int report_search(const compile::OptimiseChoices& choices, const compile::OptimiseStudy& study,
                  const compile::History& history, const Events& events);

}  // namespace ombre::jobs
