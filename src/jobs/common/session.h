// What a job gets from whoever runs it.
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

// Null, and diagnostics, when the design is wrong.
using DesignLoader = std::function<compile::LoadedPtr(const std::string& path, const compile::LoadOptions& options,
                                                      Diagnostics& diagnostics)>;

// References must live as long as the job.
struct Session {
  const Events& events;
  const StopFlag& stop;
  DesignLoader load;
  sources::SourceCache& cache;  // of the files that designs name
  std::string program;          // "ombre 0.1.0", for job.json
  // Makes requests to stop end the program at once, as long as what it returns lives: libraries of others are at work,
  // which cannot be asked to stop, and nothing has been written. May return null.
  std::function<std::shared_ptr<void>()> quit_at_once = [] { return nullptr; };
};

// Options that do not go together, in a way that only the job can see; the message says what to write instead.
using WrongArgument = options::WrongValue;

}  // namespace ombre::jobs
