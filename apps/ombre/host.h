// Programs that run commands inside of themselves.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/text/data.h"
#include "base/text/phrase.h"
#include "load/loaded.h"

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

// Null, and diagnostics, when the design is wrong.
using DesignLoader = std::function<std::shared_ptr<const compile::Loaded>(
    const std::string& path, const compile::LoadOptions& options, Diagnostics& diagnostics)>;

// A program that runs commands inside of itself, such as Python, sets here what it does in its own way. Members that
// are empty leave the way of the command line.
struct Host {
  DesignLoader load;                                 // reads designs
  std::function<void(const DataMembers&)> on_event;  // takes what --json would print
  std::function<void(const std::string&)> on_data;   // takes what else would go to stdout
  sources::SourceCache* cache = nullptr;             // of the files that designs name; null: one for each command
  FrontEnd front_end = FrontEnd::command_line;       // in whose words messages are
  const StopFlag* stop = nullptr;                    // asks a command to stop, in place of Ctrl-C
};

}  // namespace ombre::cli
