// Error diffusion over layers that arrive strip by strip.
#pragma once

#include <functional>
#include <vector>

#include "voxel/diffusion.h"
#include "voxel/tile.h"

namespace ombre::voxel {

// One layer. Rows come in order; each is done once the next is known.
class LayerDiffusion {
 public:
  LayerDiffusion(int64_t width, std::vector<MaterialId> materials, uint64_t seed, int64_t k);

  using TakeRow = std::function<void(const MaterialId* voxels)>;
  // A row's voxels: 1 where inside; `thresholds` as in selector.h, one row after the other.
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
  std::vector<std::vector<float>> fractions_;  // by material
};

}  // namespace ombre::voxel
