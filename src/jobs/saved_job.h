// Saves jobs as files, with their kind and options, and runs them.
#pragma once

#include <optional>
#include <string>

#include "base/text/diagnostic.h"
#include "base/text/record.h"
#include "jobs/common/job_kind.h"

namespace ombre::jobs {

struct SavedJob {
  const JobKind* kind = nullptr;
  DataMembers options;  // as options::read_members takes them
};

// Returns the job as JSON. Relative paths stay relative; they begin in the working folder of whoever runs it.
std::string saved_text(const SavedJob& job, const std::string& program);
// Reads a job. Returns nothing, and adds diagnostics, if the text is not a job, or its kind is unknown.
std::optional<SavedJob> read_saved_job(const SourcePtr& source, Diagnostics& diagnostics);
std::optional<SavedJob> read_saved_job(const Data& data, const MemberReader& reader);
// Returns the job as data that read_saved_job takes.
Data saved_data(const SavedJob& job, const std::string& program);

// Runs the job and returns an exit code. Throws as the kind's jobs do.
int run_saved_job(const SavedJob& job, Session& session);

}  // namespace ombre::jobs
