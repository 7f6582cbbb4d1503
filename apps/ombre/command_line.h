// The command line: commands, and what happens when one of them fails.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/data.h"
#include "base/phrase.h"

namespace ombre {
class Diagnostics;
class StopFlag;
}  // namespace ombre

namespace ombre::compile {
struct Loaded;
struct LoadOptions;
}  // namespace ombre::compile

namespace ombre::sources {
class SourceCache;
}

namespace ombre::cli {

// Exit codes.
inline constexpr int done = 0;
inline constexpr int wrong_input = 1;  // the design or the arguments
inline constexpr int failed = 2;       // a file or the machine
inline constexpr int check_failed = 3;
inline constexpr int interrupted = 130;

// Null, and diagnostics, when the design is wrong.
using DesignLoader = std::function<std::shared_ptr<const compile::Loaded>(
    const std::string& path, const compile::LoadOptions& options, Diagnostics& diagnostics)>;

// What a program that runs commands inside of itself does in its own way; what is empty goes the usual one.
struct Host {
  DesignLoader load;                                 // reads designs
  std::function<void(const DataMembers&)> on_event;  // takes what --json would print
  std::function<void(const std::string&)> on_data;   // takes what else would go to stdout
  sources::SourceCache* cache = nullptr;             // of the files that designs name; null: one for each command
  FrontEnd front_end = FrontEnd::command_line;       // in whose words messages are
  const StopFlag* stop = nullptr;                    // asks a command to stop, in place of Ctrl-C
};

// [{"name", "help", "options": [{"name", "help", "type", "is_flag", "is_list", "kind", "choices"}]}]; arguments without
// dashes are options whose names have none. Only the options of jobs say the last two.
Data describe_commands();

// Runs a whole command and returns its exit code. Throws nothing; nor may what `host` holds.
int run(int argc, const char* const* argv, const Host& host = {});

}  // namespace ombre::cli
