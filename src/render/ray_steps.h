// Sampling steps along rays, and the loss of light between samples.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math/math.h"
#include "render/film.h"
#include "render/scene.h"

namespace ombre::render {

// Rays are sampled in steps. Where a ray enters a surface, the step is halved down to a fine step.
inline constexpr double steps_per_pixel = 4;  // pixel of the picture
inline constexpr int64_t fine_per_step = 512;
// Number of steps of a ray that are sampled together.
inline constexpr int64_t steps_together = 8;
// Number of steps that one sample stands for inside of translucent material, away from surfaces.
inline constexpr int64_t murky_steps = 8;

// Samples along rays. Places are counted in fine steps, of which a step has 512.
struct RaySteps {
  double near_mm = 0, fine_mm = 0;
  int64_t steps = 0;
  Film film;

  RaySteps(const Scene& scene, const Film& of_film) : near_mm(scene.near_mm), film(of_film) {
    const double step = length_of(film);
    fine_mm = step / static_cast<double>(fine_per_step);
    const auto needed = static_cast<int64_t>(std::ceil((scene.far_mm - scene.near_mm) / step)) + 1;
    steps = (needed + steps_together - 1) / steps_together * steps_together;
  }
  static double length_of(const Film& film) {
    return film.pixel_mm * static_cast<double>(film.samples) / steps_per_pixel;
  }
  static int64_t fine_of(int64_t step) { return step * fine_per_step + fine_per_step / 2; }
  double depth(int64_t fine) const { return near_mm + (static_cast<double>(fine) + 0.5) * fine_mm; }
  float sample(double fine) const { return static_cast<float>(near_mm + (fine + 0.5) * fine_mm); }
  Vec3 first() const { return {depth(0), film.right_of(0), film.down_of(0)}; }
  Vec3 step() const { return {fine_mm, film.pixel_mm, film.pixel_mm}; }
};

// The share of light that passes through some steps, tabulated by opacity in steps of 1/1024.
class Clarity {
 public:
  // Constructs the table: a material of opacity o passes the share 1 - o along 1 / `step` steps.
  explicit Clarity(double step) {
    for (size_t n = 0; n < one_.size(); ++n) {
      const double clear = 1 - static_cast<double>(n) / grades;
      one_[n] = static_cast<float>(math::pow(clear, step));
      some_[n] = static_cast<float>(math::pow(clear, step * murky_steps));
    }
  }
  float through(float opacity, int64_t steps) const {
    const auto n = static_cast<size_t>(std::lround(std::clamp(opacity, 0.0F, 1.0F) * grades));
    if (steps == 1) return one_[n];
    if (steps == murky_steps) return some_[n];
    return static_cast<float>(math::pow(static_cast<double>(one_[n]), static_cast<double>(steps)));
  }

 private:
  static constexpr float grades = 1024;
  std::array<float, 1025> one_, some_;
};

}  // namespace ombre::render
