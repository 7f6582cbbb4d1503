#include "jobs/printable/bit_layer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>

namespace ombre::compile {
namespace {

constexpr double rounding = 1e-6;  // of a voxel

void add_row(uint64_t* to, const uint64_t* from, int64_t words) {
  for (int64_t w = 0; w < words; ++w) to[w] |= from[w];
}

bool is_empty(const uint64_t* row, int64_t words) {
  return std::all_of(row, row + words, [](uint64_t word) { return word == 0; });
}

// Adds the bits of a row to another, moved to the right, which is to greater x, or to the left if `shift` is negative.
void add_shifted(uint64_t* to, const uint64_t* from, int64_t words, int64_t shift) {
  const int64_t whole = (shift >= 0 ? shift : shift - 63) / 64, part = shift - 64 * whole;
  for (int64_t w = std::max<int64_t>(0, whole); w < std::min(words, words + whole + 1); ++w) {
    const int64_t source = w - whole;
    uint64_t bits = source < words ? from[source] << part : 0;
    if (part > 0 && source > 0) bits |= from[source - 1] >> (64 - part);
    to[w] |= bits;
  }
}

uint64_t last_word_mask(int64_t width) { return width % 64 == 0 ? ~uint64_t{0} : (uint64_t{1} << (width % 64)) - 1; }

// Adds the row to another, with copies moved by 1, 2, ... up to `most` voxels in a direction, which is 1 or -1.
void add_spread(uint64_t* to, std::vector<uint64_t> row, int64_t most, int64_t direction) {
  const auto words = static_cast<int64_t>(row.size());
  // The copies that the row holds double, until it has all of them.
  std::vector<uint64_t> wider;
  for (int64_t held = 0; held < most;) {
    const int64_t step = std::min(held + 1, most - held);
    wider = row;
    add_shifted(wider.data(), row.data(), words, direction * step);
    row.swap(wider);
    held += step;
  }
  add_row(to, row.data(), words);
}

// Returns the layer, each row dilated by a span along x that contains 0.
BitLayer spread_along_x(const BitLayer& layer, int64_t from, int64_t to) {
  BitLayer spread(layer.width(), layer.height());
  const int64_t words = layer.words();
  for (int64_t j = 0; j < layer.height(); ++j) {
    if (is_empty(layer.row(j), words)) continue;
    const std::vector<uint64_t> row(layer.row(j), layer.row(j) + words);
    add_spread(spread.row(j), row, to, 1);
    add_spread(spread.row(j), row, -from, -1);
    spread.row(j)[words - 1] &= last_word_mask(layer.width());
  }
  return spread;
}

Offsets offsets_where(const std::array<int64_t, 3>& most, const std::function<bool(int64_t, int64_t, int64_t)>& holds) {
  Offsets offsets;
  for (int64_t k = -most[2]; k <= most[2]; ++k)
    for (int64_t j = -most[1]; j <= most[1]; ++j) {
      int64_t half = -1;
      while (half < most[0] && holds(half + 1, j, k)) ++half;
      if (half >= 0) offsets.spans.push_back({j, k, -half, half});
    }
  return offsets;
}

}  // namespace

void BitLayer::set(int64_t j, int64_t begin, int64_t end) {
  uint64_t* const words = row(j);
  for (int64_t i = begin; i < end;) {
    const int64_t next = std::min(end, (i / 64 + 1) * 64);
    const uint64_t ones = next - i == 64 ? ~uint64_t{0} : (uint64_t{1} << (next - i)) - 1;
    words[i / 64] |= ones << (i % 64);
    i = next;
  }
}

uint64_t BitLayer::count() const {
  uint64_t sum = 0;
  for (const uint64_t word : bits_) sum += static_cast<uint64_t>(std::popcount(word));
  return sum;
}

void BitLayer::invert() {
  for (uint64_t& word : bits_) word = ~word;
  for (int64_t j = 0; words_ > 0 && j < height_; ++j) row(j)[words_ - 1] &= last_word_mask(width_);
}

BitLayer& BitLayer::operator&=(const BitLayer& other) {
  for (size_t n = 0; n < bits_.size(); ++n) bits_[n] &= other.bits_[n];
  return *this;
}

BitLayer& BitLayer::operator|=(const BitLayer& other) {
  for (size_t n = 0; n < bits_.size(); ++n) bits_[n] |= other.bits_[n];
  return *this;
}

BitLayer& BitLayer::remove(const BitLayer& other) {
  for (size_t n = 0; n < bits_.size(); ++n) bits_[n] &= ~other.bits_[n];
  return *this;
}

BitLayers inverted(BitLayers region) {
  for (BitLayer& layer : region.layers) layer.invert();
  return region;
}

Offsets Offsets::reflected() const {
  Offsets result;
  for (const OffsetSpan& span : spans) result.spans.push_back({-span.j, -span.k, -span.to, -span.from});
  return result;
}

int64_t Offsets::reach() const {
  int64_t most = 0;
  for (const OffsetSpan& span : spans)
    most = std::max({most, std::abs(span.j), std::abs(span.k), std::abs(span.from), std::abs(span.to)});
  return most;
}

Offsets ball_offsets(double diameter_mm, Vec3 voxel_mm) {
  std::array<int64_t, 3> count{};
  for (size_t axis = 0; axis < 3; ++axis)
    count[axis] = std::max<int64_t>(
        1, static_cast<int64_t>(std::ceil(diameter_mm / voxel_mm[static_cast<int>(axis)] - rounding)));
  // Returns the distance of a voxel of the ball from its middle, as a share of its radius along the axis.
  const auto share = [&](size_t axis, int64_t n) {
    const auto all = static_cast<double>(count[axis]);
    return (2 * static_cast<double>(n) + 1 - all) / all;
  };
  Offsets offsets;
  for (int64_t k = 0; k < count[2]; ++k)
    for (int64_t j = 0; j < count[1]; ++j) {
      const double rest = 1 + rounding - share(1, j) * share(1, j) - share(2, k) * share(2, k);
      int64_t from = 0;
      while (from < count[0] && share(0, from) * share(0, from) > rest) ++from;
      const int64_t to = count[0] - 1 - from;
      if (from > to) continue;
      const auto centred = [&](int64_t n, size_t axis) { return n - (count[axis] - 1) / 2; };
      offsets.spans.push_back({centred(j, 1), centred(k, 2), centred(from, 0), centred(to, 0)});
    }
  return offsets;
}

Offsets offsets_within(double distance_mm, Vec3 voxel_mm) {
  std::array<int64_t, 3> most{};
  for (size_t axis = 0; axis < 3; ++axis)
    most[axis] = static_cast<int64_t>(distance_mm / voxel_mm[static_cast<int>(axis)] + rounding);
  return offsets_where(most, [&](int64_t i, int64_t j, int64_t k) {
    const Vec3 apart{static_cast<double>(i) * voxel_mm.x, static_cast<double>(j) * voxel_mm.y,
                     static_cast<double>(k) * voxel_mm.z};
    return length(apart) <= distance_mm * (1 + rounding);
  });
}

Offsets offsets_nearer(double distance_mm, Vec3 voxel_mm) {
  std::array<int64_t, 3> most{};
  for (size_t axis = 0; axis < 3; ++axis)
    most[axis] = 1 + static_cast<int64_t>(distance_mm / voxel_mm[static_cast<int>(axis)] + rounding);
  const auto gap = [](int64_t n) { return static_cast<double>(std::max<int64_t>(0, std::abs(n) - 1)); };
  return offsets_where(most, [&](int64_t i, int64_t j, int64_t k) {
    return length(Vec3{gap(i) * voxel_mm.x, gap(j) * voxel_mm.y, gap(k) * voxel_mm.z}) < distance_mm * (1 - rounding);
  });
}

BitLayers dilated(const BitLayers& region, const Offsets& offsets, int64_t begin, int64_t end) {
  BitLayers made{begin, {}};
  if (region.layers.empty()) return made;
  const int64_t width = region.layers.front().width(), height = region.layers.front().height();
  made.layers.assign(static_cast<size_t>(end - begin), BitLayer(width, height));
  // Spans of the same extent along x share the rows that are spread by it.
  std::map<std::pair<int64_t, int64_t>, std::vector<OffsetSpan>> by_extent;
  for (const OffsetSpan& span : offsets.spans) by_extent[{span.from, span.to}].push_back(span);
  for (int64_t source = region.first; source < region.end(); ++source)
    for (const auto& [extent, spans] : by_extent) {
      const auto lands = [&](const OffsetSpan& span) { return source + span.k >= begin && source + span.k < end; };
      if (std::ranges::none_of(spans, lands)) continue;
      const BitLayer spread = spread_along_x(region.at(source), extent.first, extent.second);
      for (int64_t j = 0; j < height; ++j) {
        if (is_empty(spread.row(j), spread.words())) continue;
        for (const OffsetSpan& span : spans)
          if (lands(span) && j + span.j >= 0 && j + span.j < height)
            add_row(made.layers[static_cast<size_t>(source + span.k - begin)].row(j + span.j), spread.row(j),
                    spread.words());
      }
    }
  return made;
}

BitLayers eroded(BitLayers region, const Offsets& offsets, int64_t begin, int64_t end) {
  return inverted(dilated(inverted(std::move(region)), offsets.reflected(), begin, end));
}

}  // namespace ombre::compile
