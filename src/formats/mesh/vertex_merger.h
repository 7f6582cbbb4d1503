// Gives points at the same place one number.
#pragma once

#include <cstdint>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

// Same place: equal coordinates, exactly (-0 is 0). Memory: about 40 bytes for each distinct point.
class VertexMerger {
 public:
  // The number of this place, new ones counting from 0. Not for NaN. At most 2^32 - 1 places.
  uint32_t add(Vec3 p);

  const std::vector<Vec3>& places() const { return places_; }
  std::vector<Vec3> take_places() { return std::move(places_); }

 private:
  void grow();
  size_t slot(Vec3 p) const;

  std::vector<Vec3> places_;
  std::vector<uint32_t> slots_;  // open addressing; a power of two, at most half full
};

}  // namespace ombre::formats
