// A design in memory, and the options of loading it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/system/progress.h"
#include "design/design.h"
#include "sources/source_cache.h"

namespace ombre::compile {

struct LoadOptions {
  std::string materials;                 // path of a materials file; empty: the default set
  std::vector<std::string> definitions;  // "name=value", set before the script runs
  // "NAME=MATERIAL", or a file of such pairs: materials for the names and colours of an OpenSCAD script
  // (material_map.h)
  std::vector<std::string> material_map = {};
  std::vector<std::string> needed = {};                    // names of variables that a script must have
  std::function<void(const std::string&)> echo = nullptr;  // receives the script's echo; may be empty
  const StopFlag* stop = nullptr;
  int threads = 0;                        // 0: all cores
  sources::SourceCache* cache = nullptr;  // cache of the running program; null: one that lasts as long as the call
};

// A design that was read and checked.
struct Loaded {
  std::string path;
  SourcePtr source;
  design::Design design;
};
using LoadedPtr = std::shared_ptr<const Loaded>;

}  // namespace ombre::compile
