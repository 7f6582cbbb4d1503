// Gives points at the same place one number.
#include "formats/mesh/vertex_merger.h"

#include <bit>

namespace ombre::formats {
namespace {

constexpr uint32_t free_slot = UINT32_MAX;
constexpr size_t first_size = 64;

uint64_t mix(uint64_t h, double value) {
  h = (h ^ std::bit_cast<uint64_t>(value)) * 0x9E3779B97F4A7C15u;
  return h ^ (h >> 32);
}

}  // namespace

// Returns the slot of p, or the free slot where it belongs.
size_t VertexMerger::slot(Vec3 p) const {
  const size_t mask = slots_.size() - 1;
  size_t at = mix(mix(mix(0, p.x), p.y), p.z) & mask;
  while (slots_[at] != free_slot && !(places_[slots_[at]] == p)) at = (at + 1) & mask;
  return at;
}

uint32_t VertexMerger::add(Vec3 p) {
  if (2 * places_.size() >= slots_.size()) grow();
  p = p + Vec3{0, 0, 0};  // maps -0 to 0, so that equal places have equal bits
  uint32_t& found = slots_[slot(p)];
  if (found == free_slot) {
    found = static_cast<uint32_t>(places_.size());
    places_.push_back(p);
  }
  return found;
}

void VertexMerger::grow() {
  slots_.assign(slots_.empty() ? first_size : 2 * slots_.size(), free_slot);
  for (size_t i = 0; i < places_.size(); ++i) slots_[slot(places_[i])] = static_cast<uint32_t>(i);
}

}  // namespace ombre::formats
