// The command line: commands, and what happens when one of them fails.
#pragma once

#include "base/text/data.h"
#include "jobs/common/exit_codes.h"
#include "ombre/host.h"

namespace ombre::cli {

// [{"name", "help", "options": [{"name", "help", "type", "is_flag", "is_list", "kind", "choices"}]}]; arguments without
// dashes are options whose names have none. Only the options of jobs say the last two.
Data describe_commands();

// Runs a whole command and returns its exit code. Throws nothing; nor may what `host` holds.
int run(int argc, const char* const* argv, const Host& host = {});

}  // namespace ombre::cli
