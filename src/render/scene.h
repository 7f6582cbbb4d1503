// What a picture shows, as a program in the view's frame.
#pragma once

#include <array>
#include <vector>

#include "program/program.h"

namespace ombre::render {

// Inputs are (depth, right, down) in mm; right and down where the ray meets the picture plane.
struct Scene {
  // 0: is it inside? 1: is it where light does not pass? 2, 3, 4: linear red, green, blue, from 0 to 1; 5: opacity.
  enum Output : size_t { inside, opaque, red, green, blue, opacity, output_count };
  // In perspective three more, by which sources are placed: the depth, and the place (right, down) at that depth.
  program::Program program;
  double eye_mm = 0;            // in front of the picture plane; 0: rays are parallel
  bool is_translucent = false;  // else output 1 is output 0
  double near_mm = 0, far_mm = 0;
  double clarity_mm = 1;  // light goes so far through a material before the share `opacity` of it is lost
};

}  // namespace ombre::render
