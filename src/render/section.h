// What lies in a plane, seen flat: a ray for each point of the film, which ends there if it is inside.
#pragma once

#include "base/system/progress.h"
#include "render/camera.h"
#include "render/ray_cast.h"
#include "voxel/fields.h"

namespace ombre::render {

class Section {
 public:
  enum Output : size_t { inside, red, green, blue, output_count };

  // To the design's space from (column, row, 0.5) of the film, whose points lie at halves: the plane through the
  // camera's target, seen along `forward`.
  static Affine design_from_film(const Camera& camera, const Film& film);

  // The program's inputs are the film's, its outputs as above; colours are linear.
  Section(program::Program program, const Film& film);
  // Rows [begin, end). Throws Cancelled soon after it is asked to stop.
  RayBand cast(int64_t begin, int64_t end, int threads, const StopFlag& stop) const;

 private:
  int64_t width_;
  voxel::FieldEvaluator fields_;
};

}  // namespace ombre::render
