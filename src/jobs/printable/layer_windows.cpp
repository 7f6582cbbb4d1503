#include "jobs/printable/layer_windows.h"

#include <algorithm>
#include <deque>
#include <iterator>

#include "base/system/tasks.h"
#include "base/text/error.h"
#include "jobs/slice/slice_work.h"

namespace ombre::compile {
namespace {

// The flags of one layer.
struct LayerFlags {
  BitLayer solid;
  std::map<MaterialId, BitLayer> of_material;
  std::shared_ptr<const RunLayer> voxels;
};

class LayerWindows {
 public:
  LayerWindows(const Plan& plan, const WindowShape& shape, const CheckRun& run, const TakeWindow& take)
      : plan_(plan),
        shape_(shape),
        run_(run),
        take_(take),
        count_(plan.request.lattice.count),
        first_(-shape.margin()) {}

  void run() {
    SliceOptions options;
    options.threads = run_.threads;
    options.memory_bytes = run_.memory_bytes;
    const WorkSize work = size_work(plan_.request, options);
    const int64_t layers = count_[2], step = work.slab_layers;
    // Void lies below the lowest layer and above the highest.
    for (int64_t k = 0; k < shape_.margin(); ++k) waiting_.push_back(empty());
    run_ordered<std::vector<LayerFlags>>(
        static_cast<size_t>((layers + step - 1) / step), work.threads, work.window,
        [&](size_t n) {
          const int64_t begin = static_cast<int64_t>(n) * step;
          return flags_of(plan_.producer(begin, std::min(layers, begin + step), run_.stop));
        },
        [&](size_t n, std::vector<LayerFlags>& made) {
          std::ranges::move(made, std::back_inserter(waiting_));
          take(false);
          if (run_.progress)
            run_.progress->update({static_cast<uint64_t>(n + 1) * static_cast<uint64_t>(step) * voxels_of_layer(),
                                   static_cast<uint64_t>(layers) * voxels_of_layer()});
        });
    for (int64_t k = 0; k < shape_.margin(); ++k) waiting_.push_back(empty());
    take(true);
  }

 private:
  uint64_t voxels_of_layer() const { return static_cast<uint64_t>(count_[0] * count_[1]); }
  BitLayer empty_bits() const { return {count_[0] + 2 * shape_.margin(), count_[1] + 2 * shape_.margin()}; }

  LayerFlags empty() const {
    LayerFlags flags{empty_bits(), {}, nullptr};
    for (const MaterialId id : shape_.materials) flags.of_material.emplace(id, empty_bits());
    return flags;
  }

  std::vector<LayerFlags> flags_of(std::vector<voxel::LayerResult> layers) const {
    std::vector<LayerFlags> result;
    std::vector<MaterialId> row(static_cast<size_t>(count_[0]));
    for (voxel::LayerResult& layer : layers) {
      if (run_.stop && run_.stop->requested()) throw Cancelled();
      LayerFlags flags = empty();
      const RunLayer& voxels = layer.materials();
      for (int64_t j = 0; j < count_[1]; ++j) {
        voxels.row(static_cast<uint32_t>(j)).unpack(row.data());
        flag_row(row, j + shape_.margin(), flags);
      }
      if (shape_.has_voxels) flags.voxels = std::make_shared<const RunLayer>(std::move(layer.materials()));
      result.push_back(std::move(flags));
    }
    return result;
  }

  void flag_row(const std::vector<MaterialId>& row, int64_t j, LayerFlags& flags) const {
    for (size_t i = 0; i < row.size();) {
      size_t end = i + 1;
      while (end < row.size() && row[end] == row[i]) ++end;
      const auto from = static_cast<int64_t>(i) + shape_.margin(), to = static_cast<int64_t>(end) + shape_.margin();
      if (row[i] != 0) flags.solid.set(j, from, to);
      if (const auto its = flags.of_material.find(row[i]); its != flags.of_material.end()) its->second.set(j, from, to);
      i = end;
    }
  }

  // Gives layers around which all that is read is there. Many at a time are less work.
  void take(bool is_last) {
    const int64_t ready = static_cast<int64_t>(waiting_.size()) - 2 * shape_.reach;
    if (ready < 1 || (!is_last && ready < std::max<int64_t>(16, 2 * shape_.reach))) return;
    if (run_.stop && run_.stop->requested()) throw Cancelled();
    const int64_t begin = first_ + shape_.reach;
    take_(gathered(), begin, begin + ready);
    waiting_.erase(waiting_.begin(), waiting_.begin() + ready);
    first_ += ready;
  }

  SolidLayers gathered() const {
    SolidLayers layers{{first_, {}}, {}};
    for (const MaterialId id : shape_.materials) layers.of_material[id].first = first_;
    for (const LayerFlags& flags : waiting_) {
      layers.solid.layers.push_back(flags.solid);
      for (const auto& [id, bits] : flags.of_material) layers.of_material[id].layers.push_back(bits);
      if (shape_.has_voxels) layers.voxels.push_back(flags.voxels);
    }
    return layers;
  }

  const Plan& plan_;
  const WindowShape& shape_;
  const CheckRun& run_;
  const TakeWindow& take_;
  std::array<int64_t, 3> count_;
  std::deque<LayerFlags> waiting_;
  int64_t first_ = 0;  // number of the first waiting layer
};

}  // namespace

void each_window(const Plan& plan, const WindowShape& shape, const CheckRun& run, const TakeWindow& take) {
  LayerWindows(plan, shape, run, take).run();
}

}  // namespace ombre::compile
