#include "formats/smooth_row.h"

#include <algorithm>

#include "formats/equal_bytes.h"

namespace ombre::formats {
namespace {

constexpr size_t looked_at = 1024;
constexpr size_t smooth_voxels = 32;

}  // namespace

bool is_smooth(const RowView& row, uint32_t width) {
  if (!row.has_dense()) return true;
  const size_t count = std::min(row.dense.size(), looked_at);
  EqualBytes equal;
  equal.compare(row.dense.data() + 1, row.dense.data(), count - 1);
  const size_t changes = count - equal.equal_count();
  return row.runs.size() + row.dense.size() * changes / count <= width / smooth_voxels;
}

}  // namespace ombre::formats
