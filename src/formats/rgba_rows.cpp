#include "formats/rgba_rows.h"

#include <algorithm>
#include <cstring>

#include "formats/smooth_row.h"

namespace ombre::formats {
namespace {

constexpr uint8_t filter_none = 0, filter_up = 2;

Rgba difference(Rgba a, Rgba b) {
  Rgba result;
  for (size_t i = 0; i < result.size(); ++i) result[i] = static_cast<uint8_t>(a[i] - b[i]);
  return result;
}

// Steps through the runs of a row in the order of the image.
class RunReader {
 public:
  RunReader(const std::vector<Run>& runs, bool flip) : runs_(runs), flip_(flip) { load(); }

  MaterialId material() const { return current_.material; }
  uint32_t left() const { return current_.length; }
  void skip(uint32_t count) {
    current_.length -= count;
    if (current_.length == 0) load();
  }

 private:
  void load() {
    if (next_ == runs_.size()) return;
    current_ = runs_[flip_ ? runs_.size() - 1 - next_ : next_];
    ++next_;
  }

  const std::vector<Run>& runs_;
  bool flip_;
  size_t next_ = 0;
  Run current_;
};

}  // namespace

RgbaRows::RgbaRows(uint32_t width, const Palette& palette, const Samples& numbers, bool flip_x, ZlibStream& out)
    : width_(width),
      bits_(static_cast<unsigned>(numbers.bit_depth)),
      flip_x_(flip_x),
      out_(out),
      packer_(width, numbers, flip_x),
      packed_(packer_.size()),
      numbers_(packed_.size() * 8 / bits_),
      image_(numbers_.size() * sizeof(Rgba)),
      history_(width, static_cast<uint32_t>(numbers.ids.size())) {
  std::array<Rgba, 256> of_number{};
  for (const MaterialId id : numbers.ids)
    of_number[numbers.of[id]] = colours_[id] = palette.colours()[palette.entry(id)];
  for (unsigned byte = 0; byte < 256; ++byte) {
    for (unsigned end = bits_; end <= 8; end += bits_) {
      numbers_of_byte_.push_back(static_cast<uint8_t>(byte >> (8 - end) & ((1U << bits_) - 1)));
      colours_of_byte_.push_back(of_number[numbers_of_byte_.back()]);
    }
  }
}

void RgbaRows::put(const RowView& row) {
  if (is_smooth(row, width_))
    put_smooth(row);
  else
    put_dense(row);
}

void RgbaRows::put_smooth(const RowView& row) {
  set_runs(row);
  if (runs_above_.empty())
    put_runs();
  else
    put_difference();
  runs_above_.swap(runs_);
  history_.clear();
}

// All of them, be they ever so short.
void RgbaRows::set_runs(const RowView& row) {
  runs_.clear();
  const MaterialId* loose = row.dense.data();
  for (const Run& run : row.runs) {
    if (!run.is_dense) {
      runs_.push_back(run);
      continue;
    }
    for (const MaterialId* const end = loose + run.length; loose != end; ++loose) {
      const bool continues = loose != end - run.length && loose[-1] == *loose;
      if (continues)
        ++runs_.back().length;
      else
        runs_.push_back({*loose, false, 1});
    }
  }
}

void RgbaRows::put_difference() {
  put_filter(filter_up);
  RunReader here(runs_, flip_x_), above(runs_above_, flip_x_);
  Rgba pixel{};
  uint32_t count = 0;  // of equal differences so far
  for (uint32_t column = 0; column < width_;) {
    const uint32_t step = std::min(here.left(), above.left());
    const Rgba next = difference(colours_[here.material()], colours_[above.material()]);
    if (next != pixel) {
      put_stretch(pixel, count);
      pixel = next;
      count = 0;
    }
    count += step;
    column += step;
    here.skip(step);
    above.skip(step);
  }
  put_stretch(pixel, count);
}

void RgbaRows::put_runs() {
  put_filter(filter_none);
  RunReader runs(runs_, flip_x_);
  for (uint32_t column = 0; column < width_;) {
    const uint32_t count = runs.left();
    put_stretch(colours_[runs.material()], count);
    column += count;
    runs.skip(count);
  }
}

void RgbaRows::put_dense(const RowView& row) {
  runs_above_.clear();
  stretches_.clear();
  out_.deflate.literals(&filter_none, 1);
  out_.sum.add(&filter_none, 1);
  packer_.pack(row, packed_.data());
  expand();
  out_.sum.add(image_.data(), size_t{4} * width_);
  history_.put_row(numbers_.data(), image_.data(), out_.deflate);
}

void RgbaRows::expand() {
  switch (bits_) {
    case 1:
      return expand_bytes<8>();
    case 2:
      return expand_bytes<4>();
    case 4:
      return expand_bytes<2>();
    default:
      return expand_bytes<1>();
  }
}

template <size_t pixels_in_byte>
void RgbaRows::expand_bytes() {
  const uint8_t* const numbers_of_byte = numbers_of_byte_.data();  // which no byte written can move
  const Rgba* const colours_of_byte = colours_of_byte_.data();
  uint8_t *numbers = numbers_.data(), *image = image_.data();
  for (const uint8_t byte : packed_) {
    std::memcpy(numbers, numbers_of_byte + byte * pixels_in_byte, pixels_in_byte);
    std::memcpy(image, colours_of_byte + byte * pixels_in_byte, sizeof(Rgba) * pixels_in_byte);
    numbers += pixels_in_byte;
    image += sizeof(Rgba) * pixels_in_byte;
  }
}

void RgbaRows::put_filter(uint8_t filter) {
  stretches_.put_filter(filter, out_.deflate);
  out_.sum.add(&filter, 1);
}

void RgbaRows::put_stretch(Rgba pixel, uint32_t count) {
  if (count == 0) return;
  out_.sum.add_repeated(pixel, count);
  stretches_.put(pixel, count, out_.deflate);
}

}  // namespace ombre::formats
