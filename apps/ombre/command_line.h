// Runs the command line, and reports why a command fails.
#pragma once

#include "base/text/data.h"
#include "jobs/common/exit_codes.h"
#include "ombre/host.h"

namespace ombre::cli {

// Returns [{"name", "help", "options": [{"name", "help", "type", "is_flag", "is_list", "kind", "choices"}]}]. Names of
// positional arguments have no dashes. Only options of jobs have "kind" and "choices".
Data describe_commands();

// Runs a whole command and returns its exit code. Throws nothing; nor may the functions in `host`.
int run(int argc, const char* const* argv, const Host& host = {});

}  // namespace ombre::cli
