// Gives points at the same place one number.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

// Numbers distinct places; coordinates must be exactly equal, with -0 equal to 0. Uses about 40 bytes per distinct
// point.
class VertexMerger {
 public:
  // Returns the number of a place; new places are numbered from 0. Coordinates must not be NaN. At most 2^32 - 1
  // places.
  uint32_t add(Vec3 p);

  const std::vector<Vec3>& places() const { return places_; }
  std::vector<Vec3> take_places() { return std::move(places_); }

 private:
  void grow();
  size_t slot(Vec3 p) const;

  std::vector<Vec3> places_;
  std::vector<uint32_t> slots_;  // open addressing; the size is a power of two, at most half is in use
};

}  // namespace ombre::formats
