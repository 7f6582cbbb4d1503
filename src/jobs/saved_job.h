// Jobs as files: what kind they are, and their options.
#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.h"
#include "jobs/common/job_kind.h"

namespace ombre::jobs {

struct SavedJob {
  const JobKind* kind = nullptr;
  DataMembers options;  // as options::read_members takes them
};

// JSON. Relative paths stay relative: to the working folder of whoever runs it.
std::string saved_text(const SavedJob& job, const std::string& program);
// Nothing, and diagnostics, where the text is no job, or has a kind that is not known.
std::optional<SavedJob> read_saved_job(const SourcePtr& source, Diagnostics& diagnostics);

// Runs it. Returns an exit code. Throws as the kind's jobs do.
int run_saved_job(const SavedJob& job, Session& session);

}  // namespace ombre::jobs
