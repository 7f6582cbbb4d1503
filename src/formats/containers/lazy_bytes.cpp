#include "formats/containers/lazy_bytes.h"

namespace ombre::formats {
namespace {

constexpr size_t piece_bytes = size_t{64} << 10;

}  // namespace

void LazyBytes::add(std::string bytes) {
  add_rows(1, [text = std::move(bytes)](std::string& out, size_t) { out += text; });
}

void LazyBytes::add_rows(size_t count, Row row) { parts_.push_back({count, std::move(row)}); }

void LazyBytes::add(const LazyBytes& others) {
  parts_.insert(parts_.end(), others.parts_.begin(), others.parts_.end());
}

void LazyBytes::write(const ByteSink& sink) const {
  LazyBytesReader reader(*this);
  for (std::string_view piece = reader.next(); !piece.empty(); piece = reader.next()) sink(piece);
}

uint64_t LazyBytes::size() const {
  uint64_t size = 0;
  write([&size](std::string_view piece) { size += piece.size(); });
  return size;
}

std::string_view LazyBytesReader::next() {
  piece_.clear();
  while (part_ < bytes_.parts_.size() && piece_.size() < piece_bytes) {
    const LazyBytes::Rows& rows = bytes_.parts_[part_];
    for (; row_ < rows.count && piece_.size() < piece_bytes; ++row_) rows.row(piece_, row_);
    if (row_ < rows.count) break;
    ++part_;
    row_ = 0;
  }
  return piece_;
}

}  // namespace ombre::formats
