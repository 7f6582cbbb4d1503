// Reads and describes the options of `ombre slice` that the studio offers, for forms and jobs.
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
  int level = 0;      // voxels are 2^level times as long along x and y as the job's
  DataMembers given;  // the options of the request, in the order of the rows

  static const options::Spec<JobChoices>& options();
  // Equal choices have equal keys.
  std::string key() const;
};

// Reads options by their names without dashes, and "level". Values are texts, numbers, lists of numbers, or true for
// flags. `others` are members of the request that are no options. Throws RequestError for unknown members, with a list
// of the known ones, and for wrong values.
JobChoices read_job_choices(const Request& request, std::initializer_list<std::string_view> others);

// Returns the rows of the options, as options::describe has them, for forms.
DataList describe_job_options();

// Makes the error about a wrong value, in the words of the studio.
RequestError wrong_value(const options::WrongValue& error);

}  // namespace ombre::studio
