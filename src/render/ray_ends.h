// Where rays end in opaque material, kept for pictures of the same shape in other colours.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/system/hash.h"
#include "program/program.h"

namespace ombre::render {

// Of the rays of a band. It holds the sources of the shape, so that no other ones get their addresses, by which the key
// knows them.
struct RayEnds {
  // Ends lie up to a step before the first one, so that small negative numbers are places.
  static constexpr int32_t none = std::numeric_limits<int32_t>::min();
  program::Program shape;
  std::vector<int32_t> fine;  // row by row: the fine place of the end, or none

  size_t bytes() const { return sizeof(RayEnds) + fine.size() * sizeof(int32_t); }
};

// Thread-safe.
class KnownEnds {
 public:
  virtual ~KnownEnds() = default;
  // Null if they are not there.
  virtual std::shared_ptr<const RayEnds> find(const Hash& key) = 0;
  virtual void keep(const Hash& key, std::shared_ptr<const RayEnds> ends) = 0;
};

// What of the program says where the rays end: what its outputs need.
program::Program shape_alone(const program::Program& traversal);

// Of all that decides where rays end: the shape as its program, and the numbers that say where it is sampled. Nothing
// for programs that cannot be told apart so.
std::optional<Hash> key_of_ends(const program::Program& shape, std::span<const double> where);

}  // namespace ombre::render
