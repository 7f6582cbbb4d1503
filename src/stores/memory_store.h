// Keeps the pieces of a job in memory.
#pragma once

#include <map>

#include "stores/store.h"

namespace ombre::stores {

class MemoryStore : public Store {
 public:
  const Entries& finished() const override { return finished_; }
  void put(Piece piece) override {
    finished_.insert_or_assign(piece.id, entry_of(piece));
    pieces_.insert_or_assign(piece.id, std::move(piece));
  }
  void close() override {}

  const std::map<int64_t, Piece>& pieces() const { return pieces_; }

 private:
  Entries finished_;
  std::map<int64_t, Piece> pieces_;
};

}  // namespace ombre::stores
