// Error diffusion over layers that arrive strip by strip.
#pragma once

#include <functional>
#include <vector>

#include "voxel/diffusion.h"
#include "voxel/tile.h"

namespace ombre::voxel {

// Diffuses one layer. Rows come in order; each is finished when the next one is known.
class LayerDiffusion {
 public:
  LayerDiffusion(int64_t width, std::vector<MaterialId> materials, uint64_t seed, int64_t k);

  using TakeRow = std::function<void(const MaterialId* voxels)>;
  // Adds a row. `inside` is 1 for voxels inside, and `thresholds` are rows of values as in selector.h.
  void add(const MaterialId* inside, const std::vector<const float*>& thresholds, const TakeRow& take);
  void finish(const TakeRow& take);

 private:
  void keep(const MaterialId* inside, const std::vector<const float*>& thresholds);
  void diffuse(std::span<const uint8_t> next, const TakeRow& take);

  size_t width_;
  std::vector<MaterialId> materials_;
  LayerDiffuser diffuser_;
  int64_t j_ = 0;
  bool has_row_ = false;
  std::vector<uint8_t> inside_, chosen_;
  std::vector<std::vector<float>> fractions_;  // indexed by material
};

}  // namespace ombre::voxel
