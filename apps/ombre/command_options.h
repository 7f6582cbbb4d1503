// Adds options of jobs (options/option.h) to the command line.
#pragma once

#include <CLI/App.hpp>
#include <vector>

#include "options/option.h"

namespace ombre::cli {

// Adds the options to a command; each sets its member of the job at this address, which must outlive the command. A
// wrong value throws CLI::ParseError or options::WrongValue while the arguments are read.
void add_options(CLI::App& app, const std::vector<options::Option>& options, void* job);

template <class Job>
void add_options(CLI::App& app, Job& job) {
  add_options(app, Job::options().options(), &job);
}

}  // namespace ombre::cli
