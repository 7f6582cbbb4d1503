// The contents of a picture, as a program in the view's frame.
#pragma once

#include <array>
#include <vector>

#include "program/program.h"

namespace ombre::render {

// A scene. The program's inputs are (depth, right, down) in mm; right and down are those at which the ray meets the
// picture plane.
struct Scene {
  // The outputs: inside is 1 inside of the solid, opaque is 1 where no light passes; red, green and blue are linear,
  // from 0 to 1; opacity.
  enum Output : size_t { inside, opaque, red, green, blue, opacity, output_count };
  // In perspective, the program has three more outputs, by which sources are placed: the depth, and the point (right,
  // down) at that depth.
  program::Program program;
  double eye_mm = 0;            // distance of the eye in front of the picture plane; 0 for parallel rays
  bool is_translucent = false;  // otherwise output 1 equals output 0
  double near_mm = 0, far_mm = 0;
  double clarity_mm = 1;  // length of material over which the share `opacity` of the light is lost
};

}  // namespace ombre::render
