#include "formats/images/palette.h"

#include <algorithm>

#include "base/system/assert.h"

namespace ombre::formats {

Palette::Palette(Rgba background) : colours_{background}, ids_{0} { known_[0] = true; }

void Palette::add(MaterialId id, Rgba colour) {
  ASSERT(!known_[id]);
  known_[id] = true;
  entries_[id] = static_cast<uint8_t>(colours_.size());
  colours_.push_back(colour);
  ids_.push_back(id);
}

Palette Palette::first(size_t count) const {
  Palette result(colours_[0]);
  for (size_t i = 1; i < std::min(count, ids_.size()); ++i) result.add(ids_[i], colours_[i]);
  return result;
}

uint8_t Palette::entry(MaterialId id) const {
  ASSERT(known_[id]);
  return entries_[id];
}

int bits_for(size_t count) {
  int bits = 1;
  while ((size_t{1} << bits) < count) bits *= 2;
  return bits;
}

int Palette::bit_depth() const { return bits_for(colours_.size()); }

uint8_t luminance(Rgba colour) {
  return static_cast<uint8_t>((299 * colour[0] + 587 * colour[1] + 114 * colour[2] + 500) / 1000);
}

}  // namespace ombre::formats
