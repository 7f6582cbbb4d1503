// Samples along rays, evaluated in batches.
#pragma once

#include <span>
#include <vector>

#include "eval/batch/batch.h"
#include "render/ray_steps.h"
#include "render/scene.h"
#include "voxel/tile.h"

namespace ombre::render {

// A ray whose samples begin at the fine step `first`.
struct Ray {
  int64_t column = 0, row = 0, first = 0;
};

// The values of a program at samples of rays.
class RayBatch : private eval::SourceRows {
 public:
  explicit RayBatch(const RaySteps& steps) : steps_(steps), batch_(eval::kernel_sets().front()) {}

  // Prepares a program. `ranges` must hold wherever it is evaluated, and it must outlive this object. Batches have at
  // most most_samples samples.
  void compile(const program::Program& program, const std::vector<Interval>& ranges, size_t most_samples,
               const voxel::StripSources& sources);
  // Evaluates `width` samples of each ray, `stride` fine steps apart; only the program's output 0, or all outputs.
  void evaluate(std::span<const Ray> rays, int64_t stride, size_t width, bool all_outputs);

  // Returns the value at sample `i` of ray `n`; NaN counts as 0.
  float value(Scene::Output output, size_t n, size_t i) const {
    const float value = outputs_[output][n * width_ + i];
    return std::isnan(value) ? 0 : value;
  }
  // Returns the first of a ray's samples from `from` on whose value is not 0, or `width` if there is none.
  size_t first_set(Scene::Output output, size_t n, size_t from) const;
  Colour colour(size_t n, size_t i) const {
    return {value(Scene::red, n, i), value(Scene::green, n, i), value(Scene::blue, n, i)};
  }
  float depth(size_t n, size_t i) const { return depths_[n * width_ + i]; }

 private:
  bool has(const program::Read& read) const override { return sources_->has(read.tag); }
  void fill(const program::Read& read, const eval::RowsToFill& to) const override;
  template <size_t known_width>
  void place();
  int64_t fine(const Ray& ray, size_t i) const { return ray.first + stride_ * static_cast<int64_t>(i); }

  const RaySteps& steps_;
  eval::BatchEvaluator batch_;
  const voxel::StripSources* sources_ = nullptr;
  std::span<const Ray> rays_;
  int64_t stride_ = 1;
  size_t width_ = 0;  // samples per ray
  std::vector<eval::Values> outputs_;
  std::vector<float> depths_, rights_, downs_;  // coordinates of the current samples, ray by ray
};

}  // namespace ombre::render
