// Cuts a slice job into slabs, and makes the bytes of a layer's files from its channels.
#pragma once

#include <string>
#include <vector>

#include "export/image_stack.h"
#include "jobs/slice/layer_entry.h"
#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// The part of a job that is in flight at once.
struct WorkSize {
  int64_t slab_layers = 8;
  size_t window = 1;  // slabs
  int threads = 1;
  size_t memory_bytes = 0;  // the most that these slabs can take
};

// Fits the worst case, in which no two neighbours have the same material, into the allowed memory; one layer at a time
// is always allowed.
WorkSize size_work(const SliceRequest& request, const SliceOptions& options);

// Returns the threads, memory, progress and stop flag that a slice job lends to its stages.
StageLoan stage_loan(const SliceOptions& options, Progress* progress, const StopFlag* stop);
// Returns the options with the memory that stages leave to layers.
SliceOptions without_stages_memory(const SliceOptions& options);

// Returns the stretches of `range` that are not finished, cut at multiples of slab_layers.
std::vector<LayerRange> missing_slabs(LayerRange range, const stores::Entries& finished, int64_t slab_layers);

// Returns up to `most` of the slabs, in an order in which any number of first ones is spread over all of them.
std::vector<LayerRange> spread(const std::vector<LayerRange>& slabs, size_t most);

struct EncodedLayer {
  LayerEntry entry;                 // without its files
  std::vector<std::string> images;  // bytes of its files; empty if an empty layer is dropped

  uint64_t bytes() const;
};

exporting::ImageStack image_stack(const SliceRequest& request);

// Returns the images of a layer's channels, one channel after the other.
std::vector<std::string> encode_layer(const SliceRequest& request, const std::vector<voxel::ChannelPixels>& channels,
                                      const exporting::ImageStack& stack);

// Evaluates and encodes the layers of one slab. When asked to stop it throws Cancelled, or returns the layers that are
// encoded. Called from several threads.
std::vector<EncodedLayer> make_slab(const SliceRequest& request, const LayerProducer& producer,
                                    const exporting::ImageStack& stack, LayerRange slab,
                                    const StopFlag* stop = nullptr);

// Sums, for each of the request's checks, the voxels in which it failed, with the lowest one. Layers must come in
// order.
class CheckSums {
 public:
  explicit CheckSums(const SliceRequest& request);
  void add(const std::vector<voxel::CheckHits>& hits);
  bool any() const;
  std::vector<CheckReport> reports() const;

 private:
  const SliceRequest& request_;
  std::vector<voxel::CheckHits> sums_;
};

}  // namespace ombre::compile
