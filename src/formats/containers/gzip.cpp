#include "formats/containers/gzip.h"

#include <libdeflate.h>

#include <algorithm>

namespace ombre::formats {
namespace {

// Repeats shorter than this cost more than their bytes.
constexpr size_t shortest_repeat = 6;

std::string little_endian(uint32_t value) {
  std::string bytes;
  for (const int shift : {0, 8, 16, 24}) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

}  // namespace

// The header has no time, no name and no system.
GzipWriter::GzipWriter(size_t number_bytes, size_t row_bytes)
    : out_("\x1F\x8B\x08\x00\x00\x00\x00\x00\x00\xFF", 10), distances_{static_cast<uint32_t>(number_bytes)} {
  if (row_bytes <= DeflateWriter::window && row_bytes > number_bytes)
    distances_.push_back(static_cast<uint32_t>(row_bytes));
}

size_t GzipWriter::repeated(size_t at, size_t distance, size_t end) const {
  if (distance > at) return 0;
  const uint8_t *from = bytes_.data() + at, *last = bytes_.data() + end;
  return static_cast<size_t>(std::mismatch(from, last, from - distance).first - from);
}

void GzipWriter::add(const uint8_t* bytes, size_t count) {
  constexpr size_t piece = size_t{1} << 20;
  for (size_t n = 0; n < count; n += piece) {
    const size_t length = std::min(piece, count - n), kept = std::min<size_t>(bytes_.size(), DeflateWriter::window);
    bytes_.erase(bytes_.begin(), bytes_.end() - static_cast<ptrdiff_t>(kept));
    bytes_.insert(bytes_.end(), bytes + n, bytes + n + length);
    put(kept);
    sum_ = libdeflate_crc32(sum_, bytes + n, length);
    size_ += static_cast<uint32_t>(length);
  }
}

void GzipWriter::put(size_t begin) {
  const size_t end = bytes_.size();
  size_t literals = begin;  // beginning of the literals not yet written
  for (size_t at = begin; at < end;) {
    size_t best = 0;
    uint32_t distance = 0;
    for (const uint32_t candidate : distances_)
      if (const size_t length = repeated(at, candidate, end); length > best) {
        best = length;
        distance = candidate;
      }
    if (best < shortest_repeat) {
      at += 1;
      continue;
    }
    deflate_.literals(bytes_.data() + literals, at - literals);
    deflate_.match(static_cast<uint32_t>(best), distance);
    at += best;
    literals = at;
  }
  deflate_.literals(bytes_.data() + literals, end - literals);
}

void GzipWriter::finish() {
  deflate_.finish();
  out_ += take() + little_endian(sum_) + little_endian(size_);
}

std::string GzipWriter::take() {
  std::string ready = std::move(out_);
  ready.append(reinterpret_cast<const char*>(deflate_.data()), deflate_.size());
  deflate_.clear();
  out_.clear();
  return ready;
}

}  // namespace ombre::formats
