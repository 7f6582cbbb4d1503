#include "formats/smooth_row.h"

#include <algorithm>

namespace ombre::formats {
namespace {

constexpr size_t looked_at = 1024;
constexpr size_t smooth_voxels = 32;

}  // namespace

bool is_smooth(const RowView& row, uint32_t width) {
  if (!row.has_dense()) return true;
  const size_t count = std::min(row.dense.size(), looked_at);
  size_t changes = 1;
  for (size_t i = 1; i < count;) {
    uint8_t some = 0;  // few enough for a byte, of which the processor adds many at once
    for (const size_t end = std::min(count, i + 128); i < end; ++i) some += row.dense[i] != row.dense[i - 1];
    changes += some;
  }
  return row.runs.size() + row.dense.size() * changes / count <= width / smooth_voxels;
}

}  // namespace ombre::formats
