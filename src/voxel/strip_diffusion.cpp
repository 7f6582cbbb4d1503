#include "voxel/strip_diffusion.h"

namespace ombre::voxel {

LayerDiffusion::LayerDiffusion(int64_t width, std::vector<MaterialId> materials, uint64_t seed, int64_t k)
    : width_(static_cast<size_t>(width)),
      materials_(std::move(materials)),
      diffuser_(width, materials_.size(), seed, k),
      inside_(width_),
      chosen_(width_),
      fractions_(materials_.size(), std::vector<float>(width_)) {}

void LayerDiffusion::add(const MaterialId* inside, const std::vector<const float*>& thresholds, const TakeRow& take) {
  if (has_row_) diffuse({inside, width_}, take);
  keep(inside, thresholds);
}

void LayerDiffusion::finish(const TakeRow& take) {
  if (has_row_) diffuse({}, take);
  has_row_ = false;
}

// Fractions are the differences of consecutive thresholds.
void LayerDiffusion::keep(const MaterialId* inside, const std::vector<const float*>& thresholds) {
  has_row_ = true;
  inside_.assign(inside, inside + width_);
  for (size_t n = 0; n < width_; ++n) {
    float below = 0;
    for (size_t m = 0; m < materials_.size(); ++m) {
      const float above = m < thresholds.size() ? thresholds[m][n] : 1;
      fractions_[m][n] = above - below;
      below = above;
    }
  }
}

void LayerDiffusion::diffuse(std::span<const uint8_t> next, const TakeRow& take) {
  std::vector<const float*> rows;
  for (const auto& row : fractions_) rows.push_back(row.data());
  diffuser_.row(j_++, inside_, next, rows, chosen_);
  for (size_t n = 0; n < width_; ++n) chosen_[n] = inside_[n] != 0 ? materials_[chosen_[n]] : MaterialId{0};
  take(chosen_.data());
}

}  // namespace ombre::voxel
