// A store keeps the finished pieces of a long job, each with its files and a record.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "stores/journal.h"

namespace ombre::stores {

// A finished piece of a job: a layer, the evaluation of a design.
struct Piece {
  int64_t id = 0;
  std::vector<std::pair<std::string, std::string>> files;  // names and bytes
  DataMembers record;
};

// Returns what a journal says of the piece.
Entry entry_of(const Piece& piece);

// Keeps the pieces of one job. A piece that was put is kept, whatever happens after. It is used from one thread at a
// time.
class Store {
 public:
  virtual ~Store() = default;

  // Returns the pieces of earlier runs and of this one.
  virtual const Entries& finished() const = 0;
  // Keeps the piece, and replaces an earlier one with the same number.
  virtual void put(Piece piece) = 0;
  // Completes the store; no piece follows.
  virtual void close() = 0;
};

}  // namespace ombre::stores
