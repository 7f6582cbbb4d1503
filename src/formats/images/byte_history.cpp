#include "formats/images/byte_history.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace ombre::formats {
namespace {

constexpr unsigned table_bits = 12, key_bits = 32;
constexpr size_t most_kept = size_t{1} << 18;  // number of bytes kept; beyond it, all but the window is dropped
constexpr size_t fewest_bytes = 4, fewest_byte_repeats = 3;

uint64_t load(const uint8_t* bytes) {
  static_assert(std::endian::native == std::endian::little);
  uint64_t word;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

size_t slot(uint64_t word) { return (word << (64 - key_bits)) * 0x9E3779B97F4A7C15 >> (64 - table_bits); }

}  // namespace

ByteHistory::ByteHistory() : latest_(size_t{1} << table_bits) {}

void ByteHistory::clear() {
  if (end_ == 1) return;
  end_ = 1;
  std::fill(latest_.begin(), latest_.end(), 0);
}

void ByteHistory::put_row(const uint8_t* bytes, size_t size, DeflateWriter& out) {
  append(bytes, size);
  size_t written = row_;
  for (size_t at = row_; at < end_;) {
    const Match match = find(at);
    if (match.length == 0) {
      ++at;
      continue;
    }
    out.literals(&bytes_[written], at - written);
    out.match(static_cast<uint32_t>(match.length), static_cast<uint32_t>(match.distance));
    at += match.length;
    written = at;
  }
  out.literals(&bytes_[written], end_ - written);
}

void ByteHistory::append(const uint8_t* bytes, size_t size) {
  if (end_ > most_kept) {
    const size_t gone = end_ - DeflateWriter::window;
    std::memmove(bytes_.data(), &bytes_[gone], DeflateWriter::window);
    end_ -= gone;
    for (size_t& at : latest_) at -= std::min(at, gone);
  }
  row_ = end_;
  end_ += size;
  bytes_.resize(std::max(bytes_.size(), end_ + sizeof(uint64_t)));
  std::memcpy(&bytes_[row_], bytes, size);
}

// Returns the longer of two matches: with the latest place of these bytes, or with a repetition of the previous byte.
ByteHistory::Match ByteHistory::find(size_t at) {
  const size_t there = std::exchange(latest_[slot(load(&bytes_[at]))], at);
  const size_t repeats = at == row_ ? 0 : common_length(at, at - 1);
  const bool is_near = there != 0 && at - there <= DeflateWriter::window;
  const size_t length = is_near ? common_length(at, there) : 0;
  if (length > repeats && length >= fewest_bytes) return {length, at - there};
  if (repeats >= fewest_byte_repeats) return {repeats, 1};
  return {};
}

size_t ByteHistory::common_length(size_t at, size_t there) const {
  const uint8_t *const here = &bytes_[at], *const before = &bytes_[there];
  const size_t most = end_ - at;
  for (size_t i = 0; i < most; i += sizeof(uint64_t))
    if (const uint64_t differences = load(here + i) ^ load(before + i))
      return std::min(most, i + static_cast<size_t>(std::countr_zero(differences)) / 8);
  return most;
}

}  // namespace ombre::formats
