// Samples along rays, many at a time.
#pragma once

#include <span>
#include <vector>

#include "eval/batch/batch.h"
#include "render/ray_steps.h"
#include "render/scene.h"
#include "voxel/tile.h"

namespace ombre::render {

// Samples begin at the fine place `first`.
struct Ray {
  int64_t column = 0, row = 0, first = 0;
};

// What a program says at samples of rays.
class RayBatch : private eval::SourceRows {
 public:
  explicit RayBatch(const RaySteps& steps) : steps_(steps), batch_(eval::kernel_sets().front()) {}

  // `ranges` are the program's, which outlives this, wherever it is evaluated. At most so many samples at a time.
  void compile(const program::Program& program, const std::vector<Interval>& ranges, size_t most_samples,
               const voxel::StripSources& sources);
  // `width` samples of each ray, `stride` fine places apart. Only the program's output 0, or all of them.
  void evaluate(std::span<const Ray> rays, int64_t stride, size_t width, bool all_outputs);

  // Of sample `i` of ray `n`. What floats cannot hold counts as 0.
  float value(Scene::Output output, size_t n, size_t i) const {
    const float value = outputs_[output][n * width_ + i];
    return std::isnan(value) ? 0 : value;
  }
  // The first of a ray's samples at or behind `from` whose value is not 0; `width` if there is none.
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
  size_t width_ = 0;  // samples of a ray
  std::vector<eval::Values> outputs_;
  std::vector<float> depths_, rights_, downs_;  // of the samples at work, ray by ray
};

}  // namespace ombre::render
