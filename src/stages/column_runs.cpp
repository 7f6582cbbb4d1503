#include "stages/column_runs.h"

#include <algorithm>

#include "base/system/byte_pack.h"
#include "base/text/error.h"
#include "base/text/text.h"

namespace ombre::compile {
namespace {

constexpr int64_t most_columns_queried = 1024;

}  // namespace

void ColumnTable::set_limit(double bytes, std::string what) {
  limit_ = bytes;
  what_ = std::move(what);
}

void ColumnTable::add(size_t channel, int64_t i, int64_t j, int64_t bottom, int64_t top, float value) {
  // Each run counts twice, since finish() copies runs when it puts them in order.
  added_bytes_ += sizeof(Added) + sizeof(Run);
  if (limit_ && added_bytes_ > *limit_)
    throw Error(Code::memory, what_ + ": computing them takes more memory than allowed; allow more with " +
                                  spelled::option("--memory") +
                                  ", or choose larger "
                                  "voxels, or a larger pitch for its cells");
  const auto column = static_cast<uint32_t>((j - cells_.lo[1]) * cells_.size(0) + (i - cells_.lo[0]));
  channels_[channel].added.push_back({column, {static_cast<int32_t>(bottom), static_cast<int32_t>(top), value}});
}

void ColumnTable::finish() {
  for (Channel& channel : channels_) put_in_order(channel);
}

std::string ColumnTable::pack() const {
  BytePacker packer;
  for (const Channel& channel : channels_) {
    packer.add_list(channel.first);
    packer.add_list(channel.runs);
  }
  return packer.take();
}

bool ColumnTable::unpack(std::string_view bytes) {
  ByteUnpacker unpacker(bytes);
  for (Channel& channel : channels_) {
    channel.first = unpacker.get_list<uint32_t>();
    channel.runs = unpacker.get_list<Run>();
    if (channel.first.size() != columns() + 1 || channel.runs.size() != channel.first.back()) return false;
  }
  return true;
}

double ColumnTable::bytes() const {
  double bytes = static_cast<double>(sizeof(uint32_t) * columns() * channels_.size());
  for (const Channel& channel : channels_) bytes += static_cast<double>(channel.runs.size() * sizeof(Run));
  return bytes;
}

void ColumnTable::put_in_order(Channel& channel) const {
  channel.first.assign(columns() + 1, 0);
  for (const Added& added : channel.added) ++channel.first[added.column + 1];
  for (size_t c = 0; c < columns(); ++c) channel.first[c + 1] += channel.first[c];
  channel.runs.resize(channel.added.size());
  std::vector<uint32_t> next(channel.first.begin(), channel.first.end() - 1);
  for (const Added& added : channel.added) channel.runs[next[added.column]++] = added.run;
  channel.added = {};
  for (size_t c = 0; c < columns(); ++c)
    std::sort(channel.runs.begin() + channel.first[c], channel.runs.begin() + channel.first[c + 1],
              [](const Run& a, const Run& b) { return a.bottom < b.bottom; });
}

std::span<const ColumnTable::Run> ColumnTable::column(size_t channel, int64_t i, int64_t j) const {
  const Channel& from = channels_[channel];
  const auto c = static_cast<size_t>((j - cells_.lo[1]) * cells_.size(0) + (i - cells_.lo[0]));
  return std::span(from.runs).subspan(from.first[c], from.first[c + 1] - from.first[c]);
}

float ColumnTable::at(size_t channel, int64_t i, int64_t j, int64_t k) const {
  const auto runs = column(channel, i, j);
  const auto behind = std::ranges::upper_bound(runs, k, {}, &Run::bottom);
  if (behind == runs.begin()) return 0;
  const Run& run = *(behind - 1);
  return k < run.top ? run.value : 0;
}

Interval ColumnTable::range(size_t channel, const IndexBox& cells, Interval otherwise) const {
  if (cells.size(0) * cells.size(1) > most_columns_queried) return otherwise;
  std::optional<Interval> range;
  const auto add = [&](float value) { range = range ? hull(*range, value) : Interval(value); };
  for (int64_t j = cells.lo[1]; j < cells.hi[1]; ++j)
    for (int64_t i = cells.lo[0]; i < cells.hi[0]; ++i) {
      int64_t covered = 0;
      for (const Run& run : column(channel, i, j)) {
        const int64_t from = std::max<int64_t>(run.bottom, cells.lo[2]), to = std::min<int64_t>(run.top, cells.hi[2]);
        if (from >= to) continue;
        add(run.value);
        covered += to - from;
      }
      if (covered < cells.size(2)) add(0);
    }
  return range.value_or(Interval(0));
}

}  // namespace ombre::compile
