#include "formats/images/rgba_rows.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/math/byte_rows.h"
#include "formats/images/png_filters.h"
#include "formats/images/smooth_row.h"

namespace ombre::formats {
namespace {

Rgba difference(Rgba a, Rgba b) {
  Rgba result;
  for (size_t i = 0; i < result.size(); ++i) result[i] = static_cast<uint8_t>(a[i] - b[i]);
  return result;
}

// Iterates over the runs of a row in the order of the image.
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

RgbaRows::RgbaRows(uint32_t width, const Palette& palette, std::vector<MaterialId> materials, bool flip_x,
                   ZlibStream& out)
    : width_(width),
      flip_x_(flip_x),
      materials_(std::move(materials)),
      out_(out),
      image_(size_t{width} * sizeof(Rgba)),
      history_(width, static_cast<uint32_t>(materials_.size())) {
  for (size_t number = 0; number < materials_.size(); ++number) {
    const MaterialId id = materials_[number];
    const Rgba colour = palette.colours()[palette.entry(id)];
    number_of_[id] = static_cast<uint8_t>(number);
    colours_[id] = colour;
    if (number < few) colours_of_few_[number] = colour;
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

// Collects all runs of a row, however short.
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
  uint32_t count = 0;  // pixels of the current stretch of equal differences
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
  uint8_t* const numbers = history_.begin_row();
  set_numbers(row, numbers);
  set_image(numbers);
  out_.sum.add(image_.data(), image_.size());
  history_.end_row(image_.data(), out_.deflate);
}

void RgbaRows::set_numbers(const RowView& row, uint8_t* numbers) const {
  row.unpack(numbers);
  if (flip_x_) std::reverse(numbers, numbers + width_);
  if (materials_.size() <= few) return number_bytes({numbers, width_}, materials_, numbers);
  std::transform(numbers, numbers + width_, numbers, [&](MaterialId id) { return number_of_[id]; });
}

void RgbaRows::set_image(const uint8_t* numbers) {
  if (materials_.size() <= few) return look_up_four_bytes({numbers, width_}, colours_of_few_, image_.data());
  for (size_t i = 0; i < width_; ++i)
    std::memcpy(&image_[i * sizeof(Rgba)], &colours_[materials_[numbers[i]]], sizeof(Rgba));
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
