// Makes one layer of a job, with the bytes that slicing would write.
#include "jobs/slice/layer.h"

#include <algorithm>
#include <cmath>

#include "base/text/error.h"
#include "jobs/slice/slice_work.h"

namespace ombre::compile {
namespace {

// Distance in voxels within which a place counts as on a face.
constexpr double slack = 1e-6;

// Returns the distance from the lower face of the first voxel, in voxels; far outside it is some number outside.
double in_voxels(const voxel::Lattice& lattice, size_t axis, double mm) {
  const double voxels = (mm - lattice.origin[static_cast<int>(axis)]) / lattice.pitch[axis].mm();
  return std::clamp(voxels, -2.0, static_cast<double>(lattice.count[axis]) + 2);
}

}  // namespace

std::optional<int64_t> layer_at(const voxel::Lattice& lattice, double z_mm) {
  const double z = in_voxels(lattice, 2, z_mm);
  const int64_t count = lattice.count[2];
  if (!(z >= -slack && z <= static_cast<double>(count) + slack)) return std::nullopt;
  return std::clamp<int64_t>(static_cast<int64_t>(std::floor(z + slack)), 0, count - 1);
}

std::optional<std::pair<int64_t, int64_t>> voxels_over(const voxel::Lattice& lattice, size_t axis, Interval mm) {
  const double first = std::floor(in_voxels(lattice, axis, mm.lo) + slack);
  const double last = std::ceil(in_voxels(lattice, axis, mm.hi) - slack);
  const int64_t begin = std::max<int64_t>(0, static_cast<int64_t>(first));
  const int64_t end = std::min(lattice.count[axis], static_cast<int64_t>(last));
  if (begin >= end) return std::nullopt;
  return std::pair{begin, end};
}

std::optional<LayerWindow> window_over(const voxel::Lattice& lattice, double x0, double y0, double x1, double y1) {
  const auto x = voxels_over(lattice, 0, {x0, x1}), y = voxels_over(lattice, 1, {y0, y1});
  if (!x || !y) return std::nullopt;
  return LayerWindow{{x->first, y->first}, {x->second, y->second}};
}

double layer_memory_bytes(const SliceRequest& request, const std::optional<LayerWindow>& window) {
  SliceRequest seen = request;
  if (window)
    for (size_t axis = 0; axis < 2; ++axis) seen.lattice.count[axis] = window->hi[axis] - window->lo[axis];
  seen.lattice.count[2] = 1;
  SliceOptions one;
  one.threads = 1;
  one.memory_bytes = 0;
  return static_cast<double>(size_work(seen, one).memory_bytes);
}

LayerImages make_layer(const SliceRequest& request, const RegionProducer& regions, int64_t layer,
                       const std::optional<LayerWindow>& window, const StopFlag* stop) {
  SliceRequest kept = request;
  kept.drop_empty_layers = false;
  const auto& count = request.lattice.count;
  const LayerWindow pixels = window.value_or(LayerWindow{{0, 0}, {count[0], count[1]}});
  const LayerProducer producer = [&](int64_t begin, int64_t end, const StopFlag* stop) {
    return regions({{pixels.lo[0], pixels.lo[1], begin}, {pixels.hi[0], pixels.hi[1], end}}, stop);
  };
  std::vector<EncodedLayer> made = make_slab(kept, producer, image_stack(kept), {layer, layer + 1}, stop);
  if (made.empty()) throw Cancelled();
  EncodedLayer& only = made.front();
  CheckSums checks(request);
  checks.add(only.entry.checks);
  return {std::move(only.images), std::move(only.entry.counts), checks.reports()};
}

}  // namespace ombre::compile
