// From where a picture is taken.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/box.h"
#include "base/math/vec.h"

namespace ombre::render {

// Looks along `forward` at `target`; unit vectors, at right angles. Points of the view's frame are (depth, right,
// down) in mm, their origin at the target.
struct Camera {
  Vec3 target, forward{0, 1, 0}, right{1, 0, 0}, down{0, 0, -1};
  double height_mm = 100;  // of the picture, at the target
  double distance_mm = 0;  // of the eye from the target; 0: infinite, an orthographic view

  bool is_orthographic() const { return distance_mm == 0; }
  Affine design_from_view() const;  // without perspective
  // By how much a length at this depth shrinks in the picture.
  double stretch_at(double depth) const { return is_orthographic() ? 1 : (distance_mm + depth) / distance_mm; }
  // A point of the picture plane (right, down), followed to a depth; in the view's frame without perspective.
  Vec3 unprojected(Vec3 view) const;
  Vec3 in_view(Vec3 design) const;  // the inverse, from the design's space
};

struct ViewOptions {
  double azimuth_deg = -35, elevation_deg = 25;  // of the eye: 0 is in front (at -y), 90 at +x; above the horizon
  double field_of_view_deg = 0;                  // vertical; 0: orthographic
  double zoom = 1;                               // enlarges the picture's middle; the eye stays where it is
  // A view that stays where it is while the design changes: its middle, and the height of the picture there. Else the
  // box decides both.
  std::optional<Vec3> target = std::nullopt;
  std::optional<double> height_mm = std::nullopt;
};

// front, back, left, right, top, bottom, iso.
std::optional<ViewOptions> named_view(std::string_view name);
std::vector<std::string> view_names();

// So that the whole box is in a picture of these proportions (width over height), unless the view says otherwise.
Camera camera_around(const Box& box, const ViewOptions& options, double aspect);

}  // namespace ombre::render
