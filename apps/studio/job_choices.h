// The options of `ombre slice` that the studio lets people choose, as data for forms and jobs.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "jobs/common/job_options.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {

struct JobChoices {
  compile::SamplingOptions sampling;
  compile::ImageOptions images;
  int level = 0;      // voxels are 2^level times as long along x and y: 0 are the job's own
  DataMembers given;  // the options as the request has them, in the order of the rows

  static const options::Spec<JobChoices>& options();
  // Equal choices have equal keys.
  std::string key() const;
};

// Reads options by their names without dashes, values as texts, numbers, lists of numbers, or true for flags, and
// "level". `others` are the request's members that say something else. Throws RequestError for members that nobody
// knows, which names those that there are, and for wrong values.
JobChoices read_job_choices(const Request& request, std::initializer_list<std::string_view> others);

// Returns the rows of the options, as options::describe has them, for forms.
DataList describe_job_options();

// Says in the studio's words what an option cannot take.
RequestError wrong_value(const options::WrongValue& error);

}  // namespace ombre::studio
