#include "formats/images/smooth_row.h"

#include <algorithm>

#include "base/math/byte_rows.h"

namespace ombre::formats {
namespace {

constexpr size_t sampled_pixels = 1024;
constexpr size_t smooth_voxels = 32;

}  // namespace

bool is_smooth(const RowView& row, uint32_t width) {
  if (!row.has_dense()) return true;
  const size_t count = std::min(row.dense.size(), sampled_pixels);
  const size_t changes = count - count_repeats(row.dense.first(count));
  return row.runs.size() + row.dense.size() * changes / count <= width / smooth_voxels;
}

}  // namespace ombre::formats
