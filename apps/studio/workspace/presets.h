// Presets: named values of a script's variables. They are stored beside the script in OpenSCAD's format of parameter
// sets: {"parameterSets": {NAME: {VARIABLE: "VALUE"}}, "fileFormatVersion": "1"}.
#pragma once

#include <filesystem>
#include <mutex>
#include <string>

#include "base/text/data.h"
#include "studio/workspace/studio_messages.h"
#include "studio/workspace/workspace.h"

namespace ombre::studio {

// Reads and writes presets. Files of another format cause errors and stay unchanged. Thread-safe.
class Presets {
 public:
  static constexpr size_t most = 500;             // per script
  static constexpr size_t longest_name = 100;     // in bytes
  static constexpr size_t most_bytes = 1U << 20;  // per file

  explicit Presets(const Workspace& workspace) : workspace_(workspace) {}

  // These functions return [{"name", "values": {VARIABLE: "VALUE"}}] of a design in the order of its file; empty
  // without a file. They throw RequestError, and Error if the file cannot be read or written.
  DataList list(const std::string& design);
  // Saves a preset. Values are numbers, texts, truth values and lists of numbers. An existing preset of that name is
  // replaced if `replaces`.
  DataList save(const std::string& design, const std::string& name, const DataMembers& values, bool replaces);
  DataList remove(const std::string& design, const std::string& name);

 private:
  const Workspace& workspace_;
  std::mutex mutex_;
};

}  // namespace ombre::studio
