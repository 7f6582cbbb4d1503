// Options of jobs (options/option.h) on the command line.
#pragma once

#include <CLI/App.hpp>
#include <vector>

#include "options/option.h"

namespace ombre::cli {

// Adds the options to a command; each sets its member of the job at this address, which must live as long as the
// command. What does not fit is a CLI::ParseError or an options::WrongValue while the arguments are read.
void add_options(CLI::App& app, const std::vector<options::Option>& options, void* job);

template <class Job>
void add_options(CLI::App& app, Job& job) {
  add_options(app, Job::options().options(), &job);
}

}  // namespace ombre::cli
