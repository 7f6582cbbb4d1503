// How a script is run.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/system/progress.h"
#include "base/text/data.h"
#include "lang/engine/dialect.h"
#include "lang/engine/limits.h"

namespace ombre::lang {

// From the command line: takes the place of the top-level variable of that name.
struct Definition {
  std::string name;
  Data value;
};

struct Options {
  std::vector<Definition> definitions;
  std::vector<std::string> needed;  // variables that the script must have, since they are set later
  Limits limits;
  int threads = 1;                               // with more than one, long lists are read ahead of their evaluation
  const StopFlag* stop = nullptr;                // checked now and then; Cancelled is thrown
  std::function<void(const std::string&)> echo;  // one line without its end; may be empty
  // What `include` and `use` read: nothing where there is no such file. Empty for the real files.
  std::function<std::optional<std::string>(const std::string& path)> read_file;
  Dialect dialect = Dialect::vcad;
  std::vector<std::string> libraries;  // folders where `include` and `use` look last
};

}  // namespace ombre::lang
