// Loads the design of a job, and makes the options by which it is sampled.
#pragma once

#include <optional>

#include "base/text/diagnostic.h"
#include "jobs/common/job_options.h"
#include "jobs/common/session.h"
#include "load/loaded.h"

namespace ombre::jobs {

using DesignArguments = compile::DesignOptions;

// Makes plan options as compile::plan_options does, in the name of the session's program.
std::optional<compile::PlanOptions> plan_options(const compile::SamplingOptions& sampling, const Session& session,
                                                 Diagnostics& diagnostics, const compile::ImageOptions& images = {});

// Makes plan options for a job of this session, with its threads, memory and stop flag.
std::optional<compile::PlanOptions> plan_options(const compile::SamplingOptions& sampling,
                                                 const compile::WorkOptions& work, const Session& session,
                                                 Diagnostics& diagnostics, const compile::ImageOptions& images = {});

// Loads the design on up to `threads` threads; 0: all cores. Returns null, and adds diagnostics, when the design is
// wrong.
compile::LoadedPtr load_design(const DesignArguments& arguments, Session& session, Diagnostics& diagnostics,
                               int threads = 0);

}  // namespace ombre::jobs
