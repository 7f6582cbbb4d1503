// The keys of jobs whose options are recorded.
#pragma once

#include <string>
#include <vector>

#include "design/design.h"
#include "stores/job_key.h"

namespace ombre::jobs {

// Returns a key of everything that a job's results depend on: the design, the program, and the options, which are texts
// such as "--size=800x600", but for those of work and place. `name` is the design's.
stores::JobKey settings_key(const std::string& name, const design::Design& design,
                            const std::vector<std::string>& settings, const std::string& program);

}  // namespace ombre::jobs
