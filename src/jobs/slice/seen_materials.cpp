#include "jobs/slice/seen_materials.h"

#include <mutex>

#include "base/system/steady_pace.h"
#include "base/system/stopwatch.h"
#include "base/system/tasks.h"
#include "jobs/slice/slice_work.h"

namespace ombre::compile {
namespace {

class MaterialSurvey {
 public:
  MaterialSurvey(const SliceRequest& request, size_t most) : request_(request), most_(most) {}

  bool is_over() {
    const std::scoped_lock lock(mutex_);
    return seen_.size() > most_ || seen_.size() == request_.materials.size();
  }

  void add(const std::vector<voxel::LayerResult>& layers) {
    std::set<MaterialId> found;
    for (const voxel::LayerResult& layer : layers)
      find_materials(layer.materials(), [&](MaterialId id) {
        if (id != 0) found.insert(id);
        return true;
      });
    const std::scoped_lock lock(mutex_);
    seen_.merge(found);
    ++slabs_done_;
  }

  void tell(Progress* progress, size_t slabs) {
    if (!progress) return;
    const std::scoped_lock lock(mutex_);
    progress->preparing("materials that are seen", at_steady_pace(slabs_done_, slabs, watch_.seconds()));
  }

  const std::set<MaterialId>& seen() const { return seen_; }

 private:
  const SliceRequest& request_;
  const size_t most_;
  const Stopwatch watch_;
  std::mutex mutex_;
  std::set<MaterialId> seen_;
  size_t slabs_done_ = 0;
};

}  // namespace

std::set<MaterialId> seen_materials(const SliceRequest& request, const LayerProducer& layers, size_t most,
                                    const SliceOptions& options, Progress* progress, const StopFlag* stop) {
  const WorkSize size = size_work(request, options);
  const std::vector<LayerRange> all = missing_slabs({0, request.lattice.count[2]}, {}, size.slab_layers);
  const std::vector<LayerRange> slabs = spread(all, all.size());
  MaterialSurvey survey(request, most);
  run_parallel(slabs.size(), size.threads, [&](size_t n) {
    if (survey.is_over()) return;
    survey.add(layers(slabs[n].begin, slabs[n].end, stop));
    survey.tell(progress, slabs.size());
  });
  return survey.seen();
}

}  // namespace ombre::compile
