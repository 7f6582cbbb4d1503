// Lists the pieces that all shares of a job have finished.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stores/journal_folder.h"

namespace ombre::stores {

// Pieces [begin, end).
struct PieceRange {
  int64_t begin = 0, end = 0;
  bool operator==(const PieceRange&) const = default;
};

// A piece that more than one journal names.
struct Repeated {
  int64_t id = 0;
  std::vector<std::string> journals;
  bool operator==(const Repeated&) const = default;
};

struct Gathered {
  Entries finished;
  std::vector<PieceRange> gaps;    // wanted pieces that no journal names, or whose files are not there
  std::vector<Repeated> repeated;  // sorted
};

// Reads all journals of the folder, also while other processes write there. Throws Error if the folder cannot be read
// or holds another job, and Cancelled when asked to stop.
Gathered gather(const std::string& folder, const StoredJob& job, PieceRange wanted, const Checking& checking = {});

}  // namespace ombre::stores
