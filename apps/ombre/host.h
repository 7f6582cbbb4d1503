// Functions of a program that runs commands inside of itself.
#pragma once

#include <functional>
#include <string>

#include "base/text/data.h"
#include "base/text/phrase.h"
#include "jobs/common/session.h"

namespace ombre::cli {

// Functions by which a program that runs commands inside of itself, such as Python, replaces those of the command line.
// Empty members change nothing.
struct Host {
  jobs::DesignLoader load;                           // loads designs
  std::function<void(const DataMembers&)> on_event;  // receives the events that --json would print
  std::function<void(const std::string&)> on_data;   // receives other output that would go to stdout
  sources::SourceCache* cache = nullptr;             // cache of the files that designs name; null: one for each command
  FrontEnd front_end = FrontEnd::command_line;       // the front end whose spelling messages have
  const StopFlag* stop = nullptr;                    // stops a command, as Ctrl-C does
};

}  // namespace ombre::cli
