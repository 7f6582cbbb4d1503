// Where rays end in opaque material, kept for pictures of the same shape in other colours.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "program/program.h"
#include "render/ray_steps.h"

namespace ombre::render {

// Of the rays of a band. It holds the sources of the shape, so that no other ones get their addresses, by which the key
// knows them.
struct RayEnds {
  static constexpr int32_t none = -1;
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
program::Program shape_alone(const program::Program& walk);

// Of all that decides where the rays of rows [begin, end) end: the shape as its program, and where it is sampled.
// Nothing for programs that cannot be told apart so, and for rays that are too long.
std::optional<Hash> key_of_ends(const program::Program& shape, const Scene& scene, const RaySteps& steps, int64_t begin,
                                int64_t end);

}  // namespace ombre::render
