// Draws letters and shapes on a picture, with smooth edges.
#include "draw/pen.h"

#include <cmath>

namespace ombre::draw {

bool can_draw() {
#ifdef OMBRE_FREETYPE
  return true;
#else
  return false;
#endif
}

void Pen::rectangle(const Canvas& canvas, Spot upper_left, Spot lower_right, Rgb colour) {
  const Spot corners[] = {
      upper_left, {lower_right.right, upper_left.down}, lower_right, {upper_left.right, lower_right.down}};
  fill(canvas, corners, colour);
}

void Pen::line(const Canvas& canvas, Spot from, Spot to, double width, Rgb colour) {
  const double right = to.right - from.right, down = to.down - from.down, length = std::hypot(right, down);
  if (!(length > 0)) return;
  const double x = -down / length * width / 2, y = right / length * width / 2;
  const Spot corners[] = {{from.right + x, from.down + y},
                          {to.right + x, to.down + y},
                          {to.right - x, to.down - y},
                          {from.right - x, from.down - y}};
  fill(canvas, corners, colour);
}

}  // namespace ombre::draw
