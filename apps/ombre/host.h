// Programs that run commands inside of themselves.
#pragma once

#include <functional>
#include <string>

#include "base/text/data.h"
#include "base/text/phrase.h"
#include "jobs/common/session.h"

namespace ombre::cli {

// A program that runs commands inside of itself, such as Python, sets here what it does in its own way. Members that
// are empty leave the way of the command line.
struct Host {
  jobs::DesignLoader load;                           // reads designs
  std::function<void(const DataMembers&)> on_event;  // takes what --json would print
  std::function<void(const std::string&)> on_data;   // takes what else would go to stdout
  sources::SourceCache* cache = nullptr;             // of the files that designs name; null: one for each command
  FrontEnd front_end = FrontEnd::command_line;       // in whose words messages are
  const StopFlag* stop = nullptr;                    // asks a command to stop, in place of Ctrl-C
};

}  // namespace ombre::cli
