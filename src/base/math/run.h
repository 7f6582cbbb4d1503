// Layers of voxels, stored as rows of runs, with dense stretches where materials alternate.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace ombre {

using MaterialId = uint8_t;  // number of a material; 0 is void

// A run of `length` voxels: all of one material, or, if dense, the next `length` voxels of the row's dense voxels.
struct Run {
  MaterialId material = 0;  // 0 if dense
  bool is_dense = false;
  uint32_t length = 0;
  bool operator==(const Run&) const = default;
};

// A row of a layer. The lengths of its runs add up to the width. `dense` holds the voxels of all dense runs in order.
struct RowView {
  std::span<const Run> runs;
  std::span<const MaterialId> dense;

  bool has_dense() const { return !dense.empty(); }
  // Writes the row's voxels to `out`, which has room for the whole width.
  void unpack(MaterialId* out) const;
  bool operator==(const RowView& other) const;
};

// One layer, stored row by row. Row 0 has the least y.
//
// Stretches of `shortest_run` or more equal voxels are runs; all others are dense. Therefore a layer depends on its
// voxels alone, not on the pieces in which they were appended, and no voxel takes more than a byte.
class RunLayer {
 public:
  static constexpr uint32_t shortest_run = 32;

  // If the height is given, address space for all voxels is reserved, which takes memory only where it is written.
  explicit RunLayer(uint32_t width = 0, uint32_t height = 0);

  uint32_t width() const { return width_; }
  uint32_t height() const { return static_cast<uint32_t>(ends_.size()); }
  RowView row(uint32_t j) const;

  // Appends a piece to the current row. Pieces may be empty.
  void add_uniform(MaterialId material, uint32_t count);
  void add(const MaterialId* voxels, uint32_t count);
  // Ends the current row.
  void end_row();

  // Appends a whole row.
  void append_row(const MaterialId* voxels);
  void append_uniform_row(MaterialId material);

  bool operator==(const RunLayer& other) const = default;

 private:
  struct RowEnd {
    size_t runs = 0, dense = 0;
    bool operator==(const RowEnd&) const = default;
  };

  RowEnd row_begin(size_t j) const { return j == 0 ? RowEnd{} : ends_[j - 1]; }
  void put_run(MaterialId material, uint32_t count);
  void put_dense(const MaterialId* voxels, uint32_t count);
  void put_dense(MaterialId material, uint32_t count);
  void grow_dense(uint32_t count);
  void put_open();

  uint32_t width_;
  std::vector<Run> runs_;
  std::vector<MaterialId> dense_;
  std::vector<RowEnd> ends_;
  Run open_;  // the last stretch of the row, which the next piece may extend
  uint32_t filled_ = 0;
};

// Returns the number of voxels of each material in the layer, void included.
std::array<uint64_t, 256> count_materials(const RunLayer& layer);

// Calls `found` once for each material in the layer, void included, until it returns false.
void find_materials(const RunLayer& layer, const std::function<bool(MaterialId)>& found);

}  // namespace ombre
