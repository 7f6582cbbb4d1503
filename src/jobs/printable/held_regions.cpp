#include "jobs/printable/held_regions.h"

namespace ombre::compile {

BitLayer HeldRegionFinder::add(int64_t k, const BitLayer& open) {
  regions_.add(k, open);
  BitLayer held = regions_.last_where(is_enclosed);
  if (held_.height() == 0) held_ = BitLayer(open.width(), open.height());
  BitLayer mouths = held_;
  (mouths &= open).remove(held);
  cups_.add(k - 1, held_, &mouths);
  held_ = std::move(held);
  return mouths;
}

}  // namespace ombre::compile
