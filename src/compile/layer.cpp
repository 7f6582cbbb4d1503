// One layer of a job, with the bytes that slicing would write.
#include "compile/layer.h"

#include <algorithm>
#include <cmath>

#include "compile/slice_work.h"

namespace ombre::compile {
namespace {

// What lies so close to a face, in voxels, is meant to lie on it.
constexpr double slack = 1e-6;

// From the lower face of the first voxel; far outside, some number outside.
double in_voxels(const voxel::Lattice& lattice, size_t axis, double mm) {
  const double voxels = (mm - lattice.origin[static_cast<int>(axis)]) / lattice.pitch[axis].mm();
  return std::clamp(voxels, -2.0, static_cast<double>(lattice.count[axis]) + 2);
}

RunLayer cut(const RunLayer& layer, const LayerWindow& window) {
  RunLayer part(static_cast<uint32_t>(window.hi[0] - window.lo[0]));
  std::vector<MaterialId> row(layer.width());
  for (int64_t j = window.lo[1]; j < window.hi[1]; ++j) {
    layer.row(static_cast<uint32_t>(j)).unpack(row.data());
    part.append_row(row.data() + window.lo[0]);
  }
  return part;
}

}  // namespace

std::optional<int64_t> layer_at(const voxel::Lattice& lattice, double z_mm) {
  const double z = in_voxels(lattice, 2, z_mm);
  const int64_t count = lattice.count[2];
  if (!(z >= -slack && z <= static_cast<double>(count) + slack)) return std::nullopt;
  return std::clamp<int64_t>(static_cast<int64_t>(std::floor(z + slack)), 0, count - 1);
}

std::optional<LayerWindow> window_over(const voxel::Lattice& lattice, double x0, double y0, double x1, double y1) {
  LayerWindow window;
  const std::array<double, 2> from{x0, y0}, to{x1, y1};
  for (size_t axis = 0; axis < 2; ++axis) {
    const double first = std::floor(in_voxels(lattice, axis, from[axis]) + slack);
    const double last = std::ceil(in_voxels(lattice, axis, to[axis]) - slack);
    window.lo[axis] = std::max<int64_t>(0, static_cast<int64_t>(first));
    window.hi[axis] = std::min(lattice.count[axis], static_cast<int64_t>(last));
    if (window.lo[axis] >= window.hi[axis]) return std::nullopt;
  }
  return window;
}

LayerImages make_layer(const SliceRequest& request, const LayerProducer& producer, int64_t layer,
                       const std::optional<LayerWindow>& window) {
  SliceRequest kept = request;
  kept.drop_empty_layers = false;
  const LayerProducer cutting = [&](int64_t begin, int64_t end, const StopFlag* stop) {
    std::vector<voxel::LayerResult> layers = producer(begin, end, stop);
    for (voxel::LayerResult& result : layers) result.runs = cut(result.runs, *window);
    return layers;
  };
  std::vector<EncodedLayer> made = make_slab(kept, window ? cutting : producer, image_stack(kept), {layer, layer + 1});
  EncodedLayer& only = made.front();
  CheckSums checks(request);
  checks.add(only.entry.checks);
  return {std::move(only.images), std::move(only.entry.voxels), checks.reports()};
}

}  // namespace ombre::compile
