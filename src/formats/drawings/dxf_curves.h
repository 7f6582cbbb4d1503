// Curves of DXF drawings as chords.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/math/polygons.h"

namespace ombre::formats {

using ChordsOfRadius = std::function<int(double radius)>;

// Appends an arc from the ring's last point to another one; `bulge` is the tangent of a quarter of its angle.
void append_bulge(Vec2 to, double bulge, const ChordsOfRadius& chords, Ring& ring);

struct DxfSpline {
  int degree = 3;
  bool is_closed = false;
  std::vector<double> parameters, weights;  // the knots; weights may be missing
  std::vector<Vec2> controls, fits;
  std::optional<Vec2> first_way, last_way;  // directions at the ends, for curves through points
};

// Returns the curve: a rational B-spline of its control points or, without those, a cubic spline through its points.
// Empty if knots and points do not fit together.
Ring curve_of(const DxfSpline& spline);

}  // namespace ombre::formats
