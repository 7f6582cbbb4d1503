// What a program says at places on rays of the film.
#pragma once

#include <span>
#include <vector>

#include "eval/batch/batch.h"
#include "render/ray_steps.h"
#include "render/scene.h"
#include "voxel/tile.h"

namespace ombre::render {

struct RayPlace {
  int64_t column = 0, row = 0, fine = 0;
};

class RayPlaces : private eval::SourceRows {
 public:
  explicit RayPlaces(const RaySteps& steps) : steps_(steps), batch_(eval::kernel_sets().front()) {}

  // `ranges` are the program's wherever the places are.
  void evaluate(const program::Program& program, const std::vector<Interval>& ranges, std::span<const RayPlace> places,
                const voxel::StripSources& sources);
  // At place `n`. What floats cannot hold counts as 0.
  float value(Scene::Output output, size_t n) const {
    const float value = batch_.output(output)[n];
    return std::isnan(value) ? 0 : value;
  }
  Colour colour(size_t n) const { return {value(Scene::red, n), value(Scene::green, n), value(Scene::blue, n)}; }

 private:
  bool has(const program::Read& read) const override { return sources_->has(read.tag); }
  void fill(const program::Read& read, const eval::RowsToFill& to) const override;

  const RaySteps& steps_;
  eval::BatchEvaluator batch_;
  const voxel::StripSources* sources_ = nullptr;
  std::span<const RayPlace> places_;
  std::vector<float> depths_, rights_, downs_;
};

}  // namespace ombre::render
