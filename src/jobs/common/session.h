// The environment of a job, which its caller provides.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "jobs/common/events.h"
#include "jobs/common/exit_codes.h"
#include "load/loaded.h"
#include "options/option.h"
#include "sources/source_cache.h"

namespace ombre::jobs {

// A function that loads designs. It returns null, and adds diagnostics, when the design is wrong.
using DesignLoader = std::function<compile::LoadedPtr(const std::string& path, const compile::LoadOptions& options,
                                                      Diagnostics& diagnostics)>;

// The environment of a job. References must outlive the job.
struct Session {
  const Events& events;
  const StopFlag& stop;
  DesignLoader load;
  sources::SourceCache& cache;  // cache of the files that designs name
  std::string program;          // "ombre 0.1.0", for job.json
  // Returns an object during whose life a request to stop ends the program at once; may return null. It is for times
  // when other libraries work, which cannot be asked to stop, and nothing has been written.
  std::function<std::shared_ptr<void>()> quit_at_once = [] { return nullptr; };
};

// The error about options that only the job can see to exclude each other; the message says what to write instead.
using WrongArgument = options::WrongValue;

}  // namespace ombre::jobs
