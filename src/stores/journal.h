// The journal of a store: one line of JSON for each finished piece of a job.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/data.h"

namespace ombre::stores {

struct StoredFile {
  std::string name;
  uint64_t bytes = 0;
  std::string hash;  // hash of the file's bytes

  bool operator==(const StoredFile&) const = default;
};

// The line of a journal for a piece.
struct Entry {
  int64_t id = 0;                 // the number of the piece
  std::vector<StoredFile> files;  // empty if the piece has none
  DataMembers record;             // what the job itself says of the piece

  bool operator==(const Entry&) const = default;
};
using Entries = std::map<int64_t, Entry>;

// Returns the bytes of all files of the piece.
uint64_t bytes_of(const Entry& entry);

// Returns a whole number from 0 to 2^53; nothing if the data is none.
std::optional<uint64_t> whole_number(const Data* data);

// Returns the line with its end. The member for the piece's number has the name that the job gives.
std::string to_line(const std::string& id_name, const Entry& entry);
// Returns the lines of all entries, in their order.
std::string to_lines(const std::string& id_name, const Entries& entries);

// Returns the entries of a journal that can be read and that the job accepts; of two for one piece the later one. A
// torn line is not an entry, even if it is the last one and lacks only its end.
using Accepts = std::function<bool(const Entry& entry)>;
Entries parse_journal(const std::string& id_name, std::string_view text, const Accepts& accepts);

}  // namespace ombre::stores
