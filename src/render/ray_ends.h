// A cache of the ends of rays in opaque material, for pictures of the same shape in other colours.
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

// The ends of the rays of a band. It keeps the sources of the shape alive, because the key identifies them by their
// addresses.
struct RayEnds {
  // Value for rays without an end. Ends lie up to a step before the first sample, so small negative numbers are valid.
  static constexpr int32_t none = std::numeric_limits<int32_t>::min();
  program::Program shape;
  std::vector<int32_t> fine;  // row by row: the fine step of the end, or none

  size_t bytes() const { return sizeof(RayEnds) + fine.size() * sizeof(int32_t); }
};

// A cache of ends. Thread-safe.
class KnownEnds {
 public:
  virtual ~KnownEnds() = default;
  // Returns the ends, or null if the cache does not have them.
  virtual std::shared_ptr<const RayEnds> find(const Hash& key) = 0;
  virtual void keep(const Hash& key, std::shared_ptr<const RayEnds> ends) = 0;
};

// Returns the part of the program that determines where rays end: what its outputs need.
program::Program shape_alone(const program::Program& traversal);

// Returns a key of everything that determines where rays end: the program of the shape, and the numbers of where it is
// sampled. Null for programs that cannot be identified.
std::optional<Hash> key_of_ends(const program::Program& shape, std::span<const double> where);

}  // namespace ombre::render
