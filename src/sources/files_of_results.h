// The files that a file of results names, such as those that a deck includes.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/results/results.h"
#include "sources/loading.h"

namespace ombre::sources {

class ResultFiles {
 public:
  // Returns the bytes of a file, or null if there is none.
  using Read = std::function<std::shared_ptr<const std::string>(const std::string& path)>;

  // Reads the files that this one names, and those that they name. Paths begin in the folder of the first one. The
  // reader of the format reports those that are missing.
  ResultFiles(const std::string& path, std::string_view bytes, uint64_t step, const Read& read);

  const std::vector<formats::ResultsFile>& files() const { return files_; }

 private:
  // `own_name` is the name of this file in the one that names it; empty for the first.
  void add(const std::string& path, std::string_view bytes, const std::string& own_name, const Read& read);

  std::string folder_;
  uint64_t step_;
  std::vector<std::shared_ptr<const std::string>> bytes_;
  std::vector<formats::ResultsFile> files_;
};

// Reads a step of results, and the files that belong to them, from the disk; 0 is the last step. `values` is the file
// of numbers, empty for the one that lies beside an .xdmf file. Returns null, with diagnostics, if a file is invalid.
// Throws Error if it cannot be read.
std::optional<formats::Results> read_results(const std::string& path, Diagnostics& diagnostics, uint64_t step = 0,
                                             const std::string& values = "");
// Reads the files for a design. The content of `file`, which must be known, becomes that of all of them.
ResultFiles result_files(design::FilePath& file, uint64_t step, Loading& loading);

}  // namespace ombre::sources
