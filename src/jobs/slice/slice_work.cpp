// Cuts a slice job into slabs, and makes the bytes of a layer's files from its runs.
#include "jobs/slice/slice_work.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/system/assert.h"
#include "base/system/tasks.h"
#include "jobs/slice/channel_counts.h"
#include "jobs/slice/value_layers.h"
#include "voxel/image_kinds.h"

namespace ombre::compile {
namespace {

constexpr int64_t most_slab_layers = 8;  // slabs of this height stay in a second-level cache of common size

// Returns the most bits that a voxel takes in the images of a channel, if layers are noise.
double image_bits(const SliceRequest& request, const voxel::Channel& channel) {
  if (channel.type != voxel::ChannelType::material) return voxel::channel_kind(channel.type).bits;
  const double images = request.files.has_material() ? static_cast<double>(request.materials.size()) : 1;
  const double information = std::log2(static_cast<double>(request.materials.size() + 1));
  return images * voxel::image_kind(request.format).noise_bits(information);
}

// Memory of layers from evaluation to encoding.
class LayerMemory {
 public:
  explicit LayerMemory(const SliceRequest& request) : request_(request) {
    const auto& count = request.lattice.count;
    const double voxels = static_cast<double>(count[0]) * static_cast<double>(count[1]);
    for (const voxel::Channel& channel : request.channels) {
      const double pixels = voxels * std::max(1, voxel::channel_kind(channel.type).bits / 8);
      pixels_ += pixels;
      images_ += voxels * image_bits(request, channel) / 8;
      // Runs are encoded as they are, or from a copy; other pixels are turned, and then written as differences.
      copies_ = std::max(copies_, pixels > voxels ? 2 * pixels : pixels);
    }
  }

  // Returns the memory while layers are made. Pixels are freed as images are made. The image that is being made is
  // copied as it grows.
  double being_made(int64_t layers) const {
    return static_cast<double>(layers) * std::max(pixels_, images_) + copies_ + images_ + evaluation(layers);
  }
  double waiting(int64_t layers) const { return static_cast<double>(layers) * images_; }

 private:
  double evaluation(int64_t layers) const {
    const voxel::Lattice& lattice = request_.lattice;
    size_t bytes = value_working_bytes(request_.channels, lattice, layers);
    if (request_.has_materials())
      bytes += voxel::working_bytes(lattice, layers, request_.dither, request_.materials.size());
    return static_cast<double>(bytes);
  }

  const SliceRequest& request_;
  double pixels_ = 0, images_ = 0, copies_ = 0;
};

}  // namespace

WorkSize size_work(const SliceRequest& request, const SliceOptions& options) {
  const size_t threads = static_cast<size_t>(options.threads > 0 ? options.threads : core_count());
  const LayerMemory memory(request);
  const auto allowed = static_cast<double>(options.memory_bytes);
  const auto needed = [&](size_t slabs, int64_t layers) {
    const size_t made = std::min(slabs, threads);
    return static_cast<double>(made) * memory.being_made(layers) +
           static_cast<double>(slabs - made) * memory.waiting(layers);
  };

  // The window is twice the number of threads, so that none waits for the order of the files. If memory is short, slabs
  // become smaller, then threads fewer.
  size_t window = 2 * threads;
  int64_t layers = most_slab_layers;
  while (window > threads && needed(window, layers) > allowed) --window;
  while (layers > 1 && needed(window, layers) > allowed) --layers;
  while (window > 1 && needed(window, layers) > allowed) --window;

  WorkSize size;
  size.slab_layers = layers;
  size.window = window;
  size.threads = static_cast<int>(std::min(threads, window));
  size.memory_bytes = static_cast<size_t>(needed(window, layers));
  return size;
}

StageLoan stage_loan(const SliceOptions& options, Progress* progress, const StopFlag* stop) {
  return {options.threads, options.memory_bytes, progress, stop};
}

SliceOptions without_stages_memory(const SliceOptions& options) {
  SliceOptions rest = options;
  if (rest.stages)
    rest.memory_bytes -= std::min(rest.memory_bytes, rest.stages->memory_bytes(stage_loan(options, nullptr, nullptr)));
  return rest;
}

std::vector<LayerRange> missing_slabs(LayerRange range, const stores::Entries& finished, int64_t slab_layers) {
  std::vector<LayerRange> slabs;
  for (int64_t layer = range.begin; layer < range.end; ++layer) {
    if (finished.count(layer) > 0) continue;
    const bool continues = !slabs.empty() && slabs.back().end == layer && layer % slab_layers != 0;
    if (continues)
      ++slabs.back().end;
    else
      slabs.push_back({layer, layer + 1});
  }
  return slabs;
}

std::vector<LayerRange> spread(const std::vector<LayerRange>& slabs, size_t most) {
  const size_t count = std::min(most, slabs.size());
  // Multiples of the golden ratio, modulo one, are spread evenly wherever the sequence ends.
  constexpr double golden = 0.6180339887498949;
  std::vector<LayerRange> chosen;
  std::vector<char> is_chosen(slabs.size());
  double place = 0.5;
  while (chosen.size() < count) {
    const auto n = std::min(slabs.size() - 1, static_cast<size_t>(place * static_cast<double>(slabs.size())));
    if (!is_chosen[n]) chosen.push_back(slabs[n]);
    is_chosen[n] = 1;
    place += golden;
    place -= std::floor(place);
  }
  return chosen;
}

uint64_t EncodedLayer::bytes() const {
  uint64_t sum = 0;
  for (const std::string& image : images) sum += image.size();
  return sum;
}

exporting::ImageStack image_stack(const SliceRequest& request) {
  exporting::ImageStack stack{request, {}, request.lattice.pitch[0], request.lattice.pitch[1]};
  for (const SliceMaterial& material : request.materials) stack.materials.push_back({material.id, material.rgba});
  return stack;
}

std::vector<std::string> encode_layer(const SliceRequest& request, const std::vector<voxel::ChannelPixels>& channels,
                                      const exporting::ImageStack& stack) {
  std::vector<std::string> images;
  for (size_t i = 0; i < request.channels.size(); ++i)
    std::ranges::move(stack.encode(channels[i], request.channels[i].type), std::back_inserter(images));
  return images;
}

std::vector<EncodedLayer> make_slab(const SliceRequest& request, const LayerProducer& producer,
                                    const exporting::ImageStack& stack, LayerRange slab, const StopFlag* stop) {
  std::vector<voxel::LayerResult> layers = producer(slab.begin, slab.end, stop);
  ASSERT(static_cast<int64_t>(layers.size()) == slab.end - slab.begin);
  std::vector<EncodedLayer> encoded;
  for (size_t i = 0; i < layers.size() && !(stop && stop->requested()); ++i) {
    // The layer's pixels are freed when it is encoded.
    const voxel::LayerResult layer = std::move(layers[i]);
    EncodedLayer result;
    result.entry.layer = slab.begin + static_cast<int64_t>(i);
    result.entry.counts = count_voxels(request, layer);
    result.entry.checks = layer.checks;
    result.entry.checks.resize(request.check_texts.size());
    if (!request.drop_empty_layers || !result.entry.counts.is_empty())
      result.images = encode_layer(request, layer.channels, stack);
    encoded.push_back(std::move(result));
  }
  return encoded;
}

CheckSums::CheckSums(const SliceRequest& request) : request_(request), sums_(request.check_texts.size()) {}

void CheckSums::add(const std::vector<voxel::CheckHits>& hits) {
  for (size_t i = 0; i < sums_.size() && i < hits.size(); ++i) {
    if (hits[i].count == 0) continue;
    if (sums_[i].count == 0) sums_[i].first = hits[i].first;
    sums_[i].count += hits[i].count;
  }
}

bool CheckSums::any() const {
  return std::any_of(sums_.begin(), sums_.end(), [](const voxel::CheckHits& sum) { return sum.count > 0; });
}

std::vector<CheckReport> CheckSums::reports() const {
  std::vector<CheckReport> reports;
  for (size_t i = 0; i < sums_.size(); ++i) {
    if (sums_[i].count == 0) continue;
    const auto& [x, y, z] = sums_[i].first;
    const bool has_place = i < request_.check_places.size() && !request_.check_places[i].empty();
    const std::string text = (has_place ? request_.check_places[i] + ": " : "") + request_.check_texts[i];
    reports.push_back({text, sums_[i].count, request_.lattice.center(x, y, z)});
  }
  return reports;
}

}  // namespace ombre::compile
