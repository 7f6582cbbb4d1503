// Reads and writes presets: values of a script's variables under a name. They lie beside the script, in the form that
// OpenSCAD gives its parameter sets: {"parameterSets": {NAME: {VARIABLE: "VALUE"}}, "fileFormatVersion": "1"}.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>

#include "base/text/data.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// The presets of a workspace. Thread-safe. Files of another format are errors, and stay as they are.
class Presets {
 public:
  static constexpr size_t most = 500;             // for each script
  static constexpr size_t longest_name = 100;     // bytes
  static constexpr size_t most_bytes = 1U << 20;  // for each file

  explicit Presets(const Workspace& workspace) : workspace_(workspace) {}

  // These functions return [{"name", "values": {VARIABLE: "VALUE"}}] of a design, in the order of its file; an empty
  // list without a file. They throw RequestError, and Error for a file that can be neither read nor written.
  DataList list(const std::string& design);
  // Saves a preset. Values are numbers, texts, truth values and lists of numbers. An existing name is replaced if
  // `replaces` is set.
  DataList save(const std::string& design, const std::string& name, const DataMembers& values, bool replaces);
  DataList remove(const std::string& design, const std::string& name);

 private:
  const Workspace& workspace_;
  std::mutex mutex_;
};

}  // namespace ombre::studio
