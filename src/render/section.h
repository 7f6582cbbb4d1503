// A section: the solid in a plane, with a ray for each point of the film that ends there if the point is inside.
#pragma once

#include "base/system/progress.h"
#include "render/camera.h"
#include "render/ray_cast.h"
#include "voxel/fields.h"

namespace ombre::render {

class Section {
 public:
  enum Output : size_t { inside, red, green, blue, output_count };

  // Returns the map from (column, row, 0.5) of the film, whose points have half-integer coordinates, to the design's
  // space: the plane through the camera's target, seen along `forward`.
  static Affine design_from_film(const Camera& camera, const Film& film);

  // Constructs a section. The program's inputs are the film's coordinates, its outputs as above with linear colours.
  Section(program::Program program, const Film& film);
  // Returns rows [begin, end). Throws Cancelled soon after a stop is requested.
  RayBand cast(int64_t begin, int64_t end, int threads, const StopFlag& stop) const;

 private:
  int64_t width_;
  voxel::FieldEvaluator fields_;
};

}  // namespace ombre::render
