// Packs rows of voxels into image rows with one small number per pixel.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/math/byte_rows.h"
#include "base/math/run.h"
#include "formats/containers/zlib_stream.h"
#include "formats/images/byte_history.h"
#include "formats/images/difference_guess.h"
#include "formats/images/equal_bytes.h"

namespace ombre::formats {

// The pixel value of each material.
struct Samples {
  int bit_depth = 8;              // 1, 2, 4 or 8
  std::vector<MaterialId> ids;    // the materials that occur, at least one
  std::array<uint8_t, 256> of{};  // pixel values by id
};

// Packs rows; the first pixel is in the highest bits, and unused bits are zero.
class RowPacker {
 public:
  RowPacker(uint32_t width, const Samples& samples, bool flip_x);

  uint32_t width() const { return width_; }
  unsigned bit_depth() const { return bit_depth_; }
  size_t size() const { return (size_t{width_} * bit_depth_ + 7) / 8; }
  void pack(const RowView& row, uint8_t* out);

 private:
  void put_run(uint64_t begin, const Run& run, uint8_t* out) const;
  void pack_voxels(uint8_t* out) const;
  template <int bits>
  void pack_pairs(uint8_t* out) const;

  uint32_t width_;
  unsigned bit_depth_;
  bool flip_x_;
  std::array<uint8_t, 256> samples_;
  DoubleBits few_;                  // the materials whose sample is not 0, if there are few
  size_t registered_ = 0;           // number of these materials
  std::vector<uint8_t> pairs_;      // samples of two neighbours, by their ids
  std::vector<MaterialId> voxels_;  // voxels of one row, with a margin
};

// Writes packed rows, each as it is or as the difference to the row above.
class PackedRows {
 public:
  PackedRows(uint32_t width, const Samples& samples, bool flip_x, ZlibStream& out);

  // Adds the next row, from the top. The layer must outlive this object.
  void put(const RowView& row);

 private:
  void compare_neighbours(std::vector<uint8_t>& bytes, uint8_t filter);
  bool pays_as_difference(bool repeats, size_t changes);
  bool has_edges_to_follow(const RowView& row, size_t changes) const;
  bool is_noise_of_few(size_t changes);
  void write(const std::vector<uint8_t>& bytes);
  void finish_row(const std::vector<uint8_t>& bytes);

  RowPacker packer_;
  ZlibStream& out_;
  RowView above_;
  // Each holds the last byte written before, the filter, then the pixels.
  std::vector<uint8_t> row_, row_above_, difference_;
  ByteHistory history_;             // consecutive rows with edges to follow
  DifferenceGuess guess_;           // for noisy rows
  EqualBytes equal_, equal_above_;  // compared with the previous byte and with the byte above
  uint8_t last_byte_ = 0xFF;        // not a filter, so nothing repeats it
};

}  // namespace ombre::formats
