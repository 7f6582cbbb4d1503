#include "formats/images/png_rows.h"

#include <algorithm>
#include <cstring>

#include "base/math/byte_rows.h"
#include "base/system/assert.h"
#include "formats/images/png_filters.h"
#include "formats/images/smooth_row.h"

namespace ombre::formats {
namespace {

constexpr size_t fewest_changes = 16;  // changes of bytes; a row with fewer has little to gain
constexpr size_t fewest_repeats = 8;   // fewest bytes of a match
constexpr size_t pixels_at = 2;        // index of the first pixel in the buffers of PackedRows

// Returns a byte with `sample` in every pixel.
uint8_t repeated(uint8_t sample, unsigned bit_depth) {
  unsigned byte = sample;
  for (unsigned filled = bit_depth; filled < 8; filled *= 2) byte |= byte << filled;
  return static_cast<uint8_t>(byte);
}

void merge(uint8_t& byte, unsigned value, unsigned mask) {
  byte = static_cast<uint8_t>((byte & ~mask) | (value & mask));
}

// Uses its own pointers, because the compiler assumes that stores of bytes may change members.
void subtract(const uint8_t* from, const uint8_t* what, size_t count, uint8_t* out) {
  for (size_t i = 0; i < count; ++i) out[i] = static_cast<uint8_t>(from[i] - what[i]);
}

size_t pair_of(MaterialId first, MaterialId second) { return first | size_t{second} << 8; }

}  // namespace

RowPacker::RowPacker(uint32_t width, const Samples& samples, bool flip_x)
    : width_(width),
      bit_depth_(static_cast<unsigned>(samples.bit_depth)),
      flip_x_(flip_x),
      samples_(samples.of),
      voxels_(size_t{width} + 8, samples.ids.front()) {
  if (bit_depth_ == 8) return;
  for (const MaterialId id : samples.ids) {
    if (samples_[id] == 0) continue;
    if (registered_ < few_.from.size()) few_.from[registered_] = id, few_.to[registered_] = samples_[id];
    ++registered_;
  }
  pairs_.resize(size_t{1} << 16);
  for (const MaterialId a : samples.ids)
    for (const MaterialId b : samples.ids)
      pairs_[pair_of(a, b)] = static_cast<uint8_t>(samples_[a] << bit_depth_ | samples_[b]);
}

void RowPacker::pack(const RowView& row, uint8_t* out) {
  if (row.has_dense()) {
    row.unpack(voxels_.data());
    if (flip_x_) std::reverse(voxels_.begin(), voxels_.begin() + width_);
    pack_voxels(out);
  } else {
    uint64_t filled = 0;
    for (const Run& run : row.runs) {
      put_run(flip_x_ ? width_ - filled - run.length : filled, run, out);
      filled += run.length;
    }
  }
  const size_t spare_bits = size() * 8 - size_t{width_} * bit_depth_;
  merge(out[size() - 1], 0, (1U << spare_bits) - 1);
}

void RowPacker::put_run(uint64_t begin, const Run& run, uint8_t* out) const {
  const uint8_t value = repeated(samples_[run.material], bit_depth_);
  const uint64_t first_bit = begin * bit_depth_, last_bit = (begin + run.length) * bit_depth_;

  // Pixels fill a byte from its high bits down.
  const size_t first = first_bit / 8, last = last_bit / 8;
  const unsigned from_first = 0xFFU >> (first_bit % 8), before_last = 0xFF00U >> (last_bit % 8) & 0xFFU;
  if (first == last) {
    if (from_first & before_last) merge(out[first], value, from_first & before_last);
    return;
  }
  merge(out[first], value, from_first);
  std::memset(out + first + 1, value, last - first - 1);
  if (before_last) merge(out[last], value, before_last);
}

void RowPacker::pack_voxels(uint8_t* out) const {
  if (bit_depth_ == 2 && registered_ <= few_.from.size()) return pack_double_bits(voxels_.data(), few_, {out, size()});
  switch (bit_depth_) {
    case 1:
      return pack_pairs<1>(out);
    case 2:
      return pack_pairs<2>(out);
    case 4:
      return pack_pairs<4>(out);
    default:
      break;
  }
  const std::array<uint8_t, 256> samples = samples_;
  const MaterialId* const voxels = voxels_.data();
  for (size_t i = 0, count = width_; i < count; ++i) out[i] = samples[voxels[i]];
}

template <int bits>
void RowPacker::pack_pairs(uint8_t* out) const {
  constexpr size_t pairs_in_byte = 4 / bits;
  const MaterialId* at = voxels_.data();
  const uint8_t* const pairs = pairs_.data();  // local, because stores of bytes might change a member
  for (uint8_t* const end = out + size(); out != end; ++out) {
    unsigned byte = 0;
    for (size_t k = 0; k < pairs_in_byte; ++k, at += 2) byte = byte << (2 * bits) | pairs[pair_of(at[0], at[1])];
    *out = static_cast<uint8_t>(byte);
  }
}

PackedRows::PackedRows(uint32_t width, const Samples& samples, bool flip_x, ZlibStream& out)
    : packer_(width, samples, flip_x),
      out_(out),
      row_(packer_.size() + pixels_at),
      row_above_(row_.size()),
      difference_(row_.size()) {}

void PackedRows::put(const RowView& row) {
  const bool is_first = above_.runs.empty();
  const bool repeats = !is_first && row == above_;
  above_ = row;
  if (!repeats) {
    row_.swap(row_above_);
    packer_.pack(row, row_.data() + pixels_at);
  }
  compare_neighbours(row_, filter_none);
  const size_t changes = equal_.size() - equal_.equal_count();
  if (!repeats && has_edges_to_follow(row, changes)) {
    history_.put_row(row_.data() + 1, equal_.size(), out_.deflate);
    return finish_row(row_);
  }
  history_.clear();
  if (is_first || (!pays_as_difference(repeats, changes) && (repeats || !is_noise_of_few(changes)))) return write(row_);
  if (repeats)
    std::fill(difference_.begin(), difference_.end(), uint8_t{0});
  else
    subtract(row_.data() + pixels_at, row_above_.data() + pixels_at, packer_.size(), difference_.data() + pixels_at);
  compare_neighbours(difference_, filter_up);
  write(difference_);
}

// Returns true if a smooth row has many edges, but far more equal bytes between them.
bool PackedRows::has_edges_to_follow(const RowView& row, size_t changes) const {
  return changes >= fewest_changes && 4 * changes < equal_.size() && is_smooth(row, packer_.width());
}

void PackedRows::compare_neighbours(std::vector<uint8_t>& bytes, uint8_t filter) {
  bytes[0] = last_byte_;
  bytes[1] = filter;
  equal_.compare(bytes.data() + 1, bytes.data(), bytes.size() - 1);
}

// Returns true if the difference to the row above has fewer changes. In smooth shapes it is mostly zero; for dithered
// rows it contains more information than the row. An edge is two changes along the row, one of which may have moved.
bool PackedRows::pays_as_difference(bool repeats, size_t changes) {
  if (repeats) return changes > 0;
  equal_above_.compare(row_.data() + pixels_at, row_above_.data() + pixels_at, packer_.size());
  return 2 * (packer_.size() - equal_above_.equal_count()) < changes;
}

// Returns true for noise of few materials that compresses better as a difference. Rows of two materials cannot gain,
// because each bit is equally likely beside any bit above.
bool PackedRows::is_noise_of_few(size_t changes) {
  if (packer_.bit_depth() == 1 || 4 * changes < equal_.size()) return false;
  return guess_.pays(row_.data() + pixels_at, row_above_.data() + pixels_at, packer_.size());
}

// Writes long stretches of equal bytes as matches; in short stretches a byte often takes only one bit.
void PackedRows::write(const std::vector<uint8_t>& bytes) {
  const uint8_t* const stream = bytes.data() + 1;
  size_t written = 0;
  for (size_t begin = equal_.find_stretch(0); begin < equal_.size();) {
    const size_t end = equal_.stretch_end(begin);
    if (end - begin >= fewest_repeats) {
      out_.deflate.literals(stream + written, begin - written);
      out_.deflate.match(static_cast<uint32_t>(end - begin), 1);
      written = end;
    }
    begin = equal_.find_stretch(end);
  }
  out_.deflate.literals(stream + written, equal_.size() - written);
  finish_row(bytes);
}

void PackedRows::finish_row(const std::vector<uint8_t>& bytes) {
  out_.sum.add(bytes.data() + 1, bytes.size() - 1);
  last_byte_ = bytes.back();
}

}  // namespace ombre::formats
