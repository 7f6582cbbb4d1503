// Makes one layer of a job, with the bytes that slicing would write.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jobs/slice/slice_request.h"

namespace ombre::compile {

// Returns the layer of the lattice that holds the height z. Its lower face belongs to it, its upper face to the next
// one, if there is one. Returns nothing when z is outside the lattice. In these functions a place within a millionth of
// a voxel of a face lies on it.
std::optional<int64_t> layer_at(const voxel::Lattice& lattice, double z_mm);

// Returns the voxels [first, second) along an axis that share length with the stretch; nothing when none does. Its ends
// are finite.
std::optional<std::pair<int64_t, int64_t>> voxels_over(const voxel::Lattice& lattice, size_t axis, Interval mm);

// A window of voxels [lo, hi) along x and y.
struct LayerWindow {
  std::array<int64_t, 2> lo{}, hi{};
};

// Returns the voxels that share area with [x0, x1] x [y0, y1]; nothing when none does. The corners are finite.
std::optional<LayerWindow> window_over(const voxel::Lattice& lattice, double x0, double y0, double x1, double y1);

struct LayerImages {
  std::vector<std::string> bytes;  // its PNG files: one, or one for each material
  VoxelCounts counts;
  std::vector<CheckReport> checks;  // checks that failed
};

// Returns the most memory in bytes that making the layer takes, apart from stages.
double layer_memory_bytes(const SliceRequest& request, const std::optional<LayerWindow>& window);

// Makes a layer. Without a window it gives the files that slicing writes for this layer, even if slicing would drop it
// as empty; with one it gives files of the window's pixels, with counts and checks of the window.
LayerImages make_layer(const SliceRequest& request, const RegionProducer& regions, int64_t layer,
                       const std::optional<LayerWindow>& window, const StopFlag* stop = nullptr);

}  // namespace ombre::compile
