// The options of `ombre slice` that the studio offers, as data for forms and jobs.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "jobs/common/calibration_options.h"
#include "jobs/common/job_options.h"
#include "studio/workspace/studio_messages.h"

namespace ombre::studio {

inline constexpr int coarsest_level = 12;

struct JobChoices {
  compile::SamplingOptions sampling;
  compile::ImageOptions images;
  compile::CalibrationOptions calibrations;
  int level = 0;      // voxels are 2^level times as long along x and y; 0 for the job's own
  DataMembers given;  // the options as in the request, in the order of the rows

  static const options::Spec<JobChoices>& options();
  // Returns a key; equal choices have equal keys.
  std::string key() const;
};

// Reads options by their names without dashes, and "level". Values are texts, numbers, lists of numbers, or true for
// flags. `others` are the request's members with another meaning. Throws RequestError for unknown members, naming the
// known ones, and for invalid values.
JobChoices read_job_choices(const Request& request, std::initializer_list<std::string_view> others);

// Returns the rows of the options for forms, in the format of options::describe.
DataList describe_job_options();

// Returns an error in the studio's terms for a value that an option does not accept.
RequestError wrong_value(const options::WrongValue& error);

}  // namespace ombre::studio
