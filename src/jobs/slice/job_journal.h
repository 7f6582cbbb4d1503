// The journal of a job: one line of JSON for each finished layer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "voxel/layers.h"

namespace ombre::compile {

struct JournalFile {
  std::string name;
  uint64_t bytes = 0;
  std::string hash;  // hash of the file's bytes
};

struct JournalEntry {
  int64_t layer = 0;                     // counted from the lowest layer of the job
  std::vector<JournalFile> files;        // empty if an empty layer was dropped
  std::vector<uint64_t> voxels;          // count for each of the job's materials
  std::vector<voxel::CheckHits> checks;  // hits of each of the job's checks

  bool is_empty() const;
};

// Returns the line with its end.
std::string to_line(const JournalEntry& entry);

// Returns nothing for a line that is torn or not of this job.
std::optional<JournalEntry> parse_entry(std::string_view line, size_t material_count, size_t check_count);

// Returns the entries of a journal that can be read, sorted by layer; of two for one layer the later one.
std::vector<JournalEntry> parse_journal(std::string_view text, size_t material_count, size_t check_count);

// Returns the files that a journal names, whatever job it belongs to.
std::vector<std::string> journal_files(std::string_view text);

}  // namespace ombre::compile
