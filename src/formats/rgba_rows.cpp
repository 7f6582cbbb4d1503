#include "formats/rgba_rows.h"

#include <algorithm>
#include <cstring>

namespace ombre::formats {
namespace {

constexpr uint8_t filter_none = 0, filter_up = 2;
constexpr uint32_t fewest_pixels = 4;  // a match of less costs more than its pixels
constexpr uint64_t measured_rows = 64;
constexpr uint32_t smooth_pixels = 32;  // to a run, on average

void expand(std::span<const MaterialId> voxels, const std::array<Rgba, 256>& colours, std::span<uint8_t> bytes) {
  uint8_t* out = bytes.data();
  for (const MaterialId id : voxels) {
    std::memcpy(out, colours[id].data(), sizeof(Rgba));
    out += sizeof(Rgba);
  }
}

// So many that as often as not another such stretch lies among the last 1024 or so pixels. Two pixels that
// are independent agree with the probability with which neighbours do.
uint32_t key_pixels(double agreeing) {
  constexpr uint32_t fewest = 4, most = 8;
  constexpr double rarest = 1.0 / 1024;
  double probability = agreeing;
  uint32_t count = 1;
  while (count < most && probability > rarest) {
    probability *= agreeing;
    ++count;
  }
  return std::max(count, fewest);
}

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

RgbaRows::RgbaRows(uint32_t width, const Palette& palette, bool flip_x, ZlibStream& out)
    : width_(width), flip_x_(flip_x), out_(out), history_(width), voxels_(width), bytes_(size_t{4} * width) {
  for (const MaterialId id : palette.ids()) colours_[id] = palette.colours()[palette.entry(id)];
}

void RgbaRows::put(const RowView& row) {
  if (row.has_dense()) equal_.compare(row.dense.data() + 1, row.dense.data(), row.dense.size() - 1);
  const size_t alike = row.has_dense() ? equal_.equal_count() : 0;
  const size_t stretches = row.runs.size() + row.dense.size() - alike;  // at most
  const bool is_smooth = !row.has_dense() || stretches <= width_ / smooth_pixels;
  if (is_smooth)
    put_smooth(row);
  else
    put_dense(row, alike);
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

void RgbaRows::put_dense(const RowView& row, size_t alike) {
  runs_above_.clear();
  put_filter(filter_none);
  row.unpack(voxels_.data());
  if (flip_x_) std::reverse(voxels_.begin(), voxels_.end());
  expand(voxels_, colours_, bytes_);
  out_.sum.add(bytes_.data(), bytes_.size());

  if (dense_rows_++ % measured_rows == 0) {
    const auto voxels = static_cast<double>(row.dense.size());
    history_.set_key_pixels(key_pixels(static_cast<double>(alike) / voxels));
  }
  history_.add_row(voxels_.data());
  uint32_t written = 0;
  for (uint32_t column = 0; column < width_;) {
    const PixelHistory::Match match = history_.find(column);
    if (match.pixels < fewest_pixels) {
      ++column;
      continue;
    }
    out_.deflate.literals(bytes_.data() + size_t{4} * written, size_t{4} * (column - written));
    out_.deflate.match(4 * match.pixels, match.distance);
    written = column + match.pixels;
    column = written;
  }
  out_.deflate.literals(bytes_.data() + size_t{4} * written, size_t{4} * (width_ - written));
}

void RgbaRows::put_filter(uint8_t filter) {
  out_.deflate.literals(&filter, 1);
  out_.sum.add(&filter, 1);
}

void RgbaRows::put_stretch(Rgba pixel, uint32_t count) {
  if (count == 0) return;
  out_.sum.add_repeated(pixel, count);
  const bool is_one_byte = pixel == Rgba{pixel[0], pixel[0], pixel[0], pixel[0]};
  const uint32_t period = is_one_byte ? 1 : 4;
  out_.deflate.literals(pixel.data(), period);
  if (4 * count > period) out_.deflate.match(4 * count - period, period);
}

}  // namespace ombre::formats
