// A store keeps the finished pieces of a long job, each with its files and a record.
#include "stores/store.h"

#include "base/system/hash.h"

namespace ombre::stores {

Entry entry_of(const Piece& piece) {
  Entry entry{piece.id, {}, piece.record};
  for (const auto& [name, bytes] : piece.files) entry.files.push_back({name, bytes.size(), hash_bytes(bytes).hex()});
  return entry;
}

}  // namespace ombre::stores
