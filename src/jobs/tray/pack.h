// Packs rectangles onto a tray.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace ombre::compile {

// A rectangle of the tray. Its sides are whole voxels, so that nothing is rounded.
struct Rectangle {
  int64_t width = 0, height = 0;
};

struct PackPlace {
  int64_t x = 0, y = 0;
};

// Places rectangles onto a tray, none turned, with a gap along x or y between any two, by maximal rectangles and best
// short sides (Jylanki 2010, "A Thousand Ways to Pack the Bin"), the largest first. Returns a place for each, in their
// order; nothing for those that found none. The result depends on the arguments alone.
std::vector<std::optional<PackPlace>> pack(const std::vector<Rectangle>& rectangles, Rectangle tray, Rectangle gap);

}  // namespace ombre::compile
