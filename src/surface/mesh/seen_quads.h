// Remembers which quads are unchanged since they were last checked, by hashes of their shapes.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/cells/crossings.h"

namespace ombre::surface {

class SeenQuads {
 public:
  // Returns the quads whose hash changed, in order, and marks all as seen.
  std::vector<uint32_t> see(const std::vector<uint64_t>& shape_hashes) {
    std::vector<uint32_t> different;
    seen_.resize(shape_hashes.size());
    for (uint32_t n = 0; n < shape_hashes.size(); ++n)
      if (seen_[n] != shape_hashes[n]) different.push_back(n);
    seen_ = shape_hashes;
    return different;
  }
  void forget(uint32_t quad) { seen_[quad] = 0; }

  // Updates the numbers of quads after a subdivision renumbered the crossings.
  void renumber(const std::vector<Crossing>& crossings) {
    std::vector<uint64_t> seen(crossings.size());
    for (size_t n = 0; n < crossings.size(); ++n)
      if (crossings[n].before != Crossing::none) seen[n] = seen_[crossings[n].before];
    seen_ = std::move(seen);
  }

 private:
  std::vector<uint64_t> seen_;
};

}  // namespace ombre::surface
