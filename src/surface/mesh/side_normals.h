// Stores for each side the normal of the first facet that has it.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/math/vec.h"

namespace ombre::surface {

// A hash table with open addressing: it holds millions of sides for a short time, and the nodes of std::unordered_map
// would take seconds to free.
class SideNormals {
 public:
  // Stores the normal if the side is new. Returns the stored normal, and whether the side was new.
  std::pair<Vec3, bool> keep(uint32_t a, uint32_t b, Vec3 normal) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    Slot& slot = slot_of(a, b);
    if (!slot.is_free()) return {slot.normal, false};
    slot = {a, b, normal};
    ++count_;
    return {normal, true};
  }

 private:
  // A slot is free if a == b, because no side has equal ends.
  struct Slot {
    uint32_t a = 0, b = 0;
    Vec3 normal;
    bool is_free() const { return a == b; }
  };

  Slot& slot_of(uint32_t a, uint32_t b) {
    constexpr uint64_t golden = 0x9E3779B97F4A7C15U;
    const uint64_t key = (a | uint64_t{b} << 32) * golden;
    size_t place = (key ^ key >> 32) & (slots_.size() - 1);
    while (!slots_[place].is_free() && (slots_[place].a != a || slots_[place].b != b))
      place = (place + 1) & (slots_.size() - 1);
    return slots_[place];
  }

  void grow() {
    std::vector<Slot> before(slots_.empty() ? 1024 : 2 * slots_.size());
    before.swap(slots_);
    for (const Slot& slot : before)
      if (!slot.is_free()) slot_of(slot.a, slot.b) = slot;
  }

  std::vector<Slot> slots_;  // the size is a power of two
  size_t count_ = 0;
};

}  // namespace ombre::surface
