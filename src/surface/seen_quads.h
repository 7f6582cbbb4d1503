// Which quads look as they did when they were last looked at.
#pragma once

#include <cstdint>
#include <vector>

#include "surface/crossings.h"

namespace ombre::surface {

class SeenQuads {
 public:
  // Those that look different, in order; from now on they are seen.
  std::vector<uint32_t> see(const std::vector<uint64_t>& looks) {
    std::vector<uint32_t> different;
    seen_.resize(looks.size());
    for (uint32_t n = 0; n < looks.size(); ++n)
      if (seen_[n] != looks[n]) different.push_back(n);
    seen_ = looks;
    return different;
  }
  void forget(uint32_t quad) { seen_[quad] = 0; }

  // After a cut the quads around crossings have other numbers.
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
