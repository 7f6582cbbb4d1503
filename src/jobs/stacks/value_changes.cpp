#include "jobs/stacks/value_changes.h"

#include <algorithm>
#include <cmath>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "base/text/text.h"
#include "jobs/stacks/marked_layer.h"

namespace ombre::compile {
namespace {

using voxel::Channel;
using voxel::ChannelType;

bool is_colour(const Channel& channel) { return channel.type == ChannelType::colour; }

std::string channels_text(const std::vector<Channel>& channels) {
  std::vector<std::string> texts;
  for (const Channel& channel : channels)
    texts.push_back(channel.name + " (" + voxel::channel_kind(channel.type).plural + ")");
  return join(texts, ", ");
}

// Returns the least difference of two numbers between neighbouring shades of the channel.
double step_of(const Channel& channel) { return value_of_shade(channel, 1) - value_of_shade(channel, 0); }

// The difference of voxels of two channels.
class Difference {
 public:
  Difference(const Channel& a, const Channel& b) : a_(a), b_(b), is_colour_(is_colour(a)) {
    if (a.type != b.type || !(a.range == b.range)) within_ = (std::abs(step_of(a)) + std::abs(step_of(b))) / 2;
  }

  // Returns how much more the second voxel has; for colours, how much they differ.
  double operator()(uint32_t first, uint32_t second) const {
    if (is_colour_) return colours(first, second);
    const double more = value_of_shade(b_, second) - value_of_shade(a_, first);
    return std::abs(more) > within_ ? more : 0;
  }

 private:
  static double colours(uint32_t first, uint32_t second) {
    int most = 0;
    for (const int shift : {24, 16, 8, 0})
      most = std::max(most, std::abs(static_cast<int>(first >> shift & 255) - static_cast<int>(second >> shift & 255)));
    return most;
  }

  const Channel &a_, &b_;
  bool is_colour_;
  double within_ = 0;  // what rounding to shades may make
};

void enlarge(IndexBox& box, const IndexBox& by, bool is_first) {
  for (size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = is_first ? by.lo[axis] : std::min(box.lo[axis], by.lo[axis]);
    box.hi[axis] = is_first ? by.hi[axis] : std::max(box.hi[axis], by.hi[axis]);
  }
}

ValueChange compare(const Shown& a, const Shown& b, const Difference& difference, int64_t width, int64_t layer) {
  ValueChange change;
  for (size_t n = 0; n < a.size(); ++n) {
    const double by = std::abs(difference(a[n], b[n]));
    if (by == 0) continue;
    const std::array<int64_t, 3> at{static_cast<int64_t>(n) % width, static_cast<int64_t>(n) / width, layer};
    enlarge(change.box, {at, {at[0] + 1, at[1] + 1, layer + 1}}, change.voxels == 0);
    ++change.voxels;
    change.sum += by;
    if (by <= change.greatest) continue;
    change.greatest = by;
    change.where = at;
  }
  return change;
}

void add(ValueChange& all, const ValueChange& layer) {
  if (layer.voxels == 0) return;
  enlarge(all.box, layer.box, all.voxels == 0);
  all.voxels += layer.voxels;
  all.sum += layer.sum;
  if (layer.greatest <= all.greatest) return;
  all.greatest = layer.greatest;
  all.where = layer.where;
}

}  // namespace

void check_same_channels(const ComparedSource& a, const ComparedSource& b) {
  const auto shows_values = [](const ComparedSource& source) {
    return source.stack && !source.stack->request().has_materials();
  };
  for (const ComparedSource* source : {&a, &b})
    if (!shows_values(*source))
      throw Error(Code::file_kind,
                  (source == &a ? b : a).path + " shows values, so " + source->path +
                      " has to be a stack of values, too; slice it with the same " + spelled::option("--by"),
                  {{"file", source->path}});
  const std::vector<Channel>&first = a.stack->request().channels, &second = b.stack->request().channels;
  const auto is_like = [](const Channel& one, const Channel& other) {
    return one.name == other.name && is_colour(one) == is_colour(other);
  };
  if (!std::ranges::equal(first, second, is_like))
    throw Error(Code::file_kind,
                a.path + " shows " + channels_text(first) + ", and " + b.path + " shows " + channels_text(second) +
                    "; only stacks of the same values can be compared",
                {{"file", b.path}});
}

ValueChanges value_changes(const ComparedValues& a, const ComparedValues& b, const voxel::Lattice& lattice,
                           const CheckWork& work) {
  ValueChanges changes;
  std::vector<Difference> differences;
  for (size_t n = 0; n < a.channels.size(); ++n) {
    changes.channels.push_back({a.channels[n], 0, 0, 0, {}, {}});
    differences.emplace_back(a.channels[n], b.channels[n]);
  }
  const auto count = static_cast<size_t>(lattice.count[2]);
  using Layer = std::vector<ValueChange>;
  const auto produce = [&](size_t k) {
    if (work.stop && work.stop->requested()) throw Cancelled();
    const auto layer = static_cast<int64_t>(k);
    const std::vector<Shown> first = a.layer(layer), second = b.layer(layer);
    Layer found;
    for (size_t n = 0; n < differences.size(); ++n)
      found.push_back(compare(first[n], second[n], differences[n], lattice.count[0], layer));
    return found;
  };
  const auto consume = [&](size_t k, Layer& found) {
    uint64_t most = 0;
    for (size_t n = 0; n < found.size(); ++n) {
      add(changes.channels[n], found[n]);
      most = std::max(most, found[n].voxels);
    }
    if (most > 0) changes.layers.push_back({static_cast<int64_t>(k), most});
    if (work.progress) work.progress->update({k + 1, count});
  };
  constexpr size_t window = 64;
  run_ordered<Layer>(count, work.threads, window, produce, consume);
  std::ranges::stable_sort(changes.layers, std::ranges::greater(), &LayerChanges::voxels);
  return changes;
}

std::string picture_of_values(const ComparedValues& a, const ComparedValues& b, const voxel::Lattice& lattice,
                              int64_t layer) {
  const Channel& channel = a.channels.front();
  const Shown before = a.layer(layer).front(), after = b.layer(layer).front();
  const Difference difference(channel, b.channels.front());
  std::vector<uint8_t> flags(before.size());
  for (size_t n = 0; n < before.size(); ++n) {
    const double more = difference(before[n], after[n]);
    if (more != 0) flags[n] = is_colour(channel) ? 3 : more < 0 ? 1 : 2;
  }
  const auto byte = [](uint32_t value) { return static_cast<uint8_t>(value & 255); };
  const int last = std::max(1, voxel::channel_kind(channel.type).last_shade);
  const auto colour = [&](size_t n) -> formats::Rgba {
    const uint32_t shown = before[n];
    if (is_colour(channel)) return {byte(shown >> 24), byte(shown >> 16), byte(shown >> 8), byte(shown)};
    const uint8_t gray = byte(shown * 255 / static_cast<uint32_t>(last));
    return {gray, gray, gray, 255};
  };
  return marked_layer(lattice, colour, flags);
}

}  // namespace ombre::compile
