// The camera of a picture.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/box.h"
#include "base/math/vec.h"

namespace ombre::render {

// A camera that looks along `forward` at `target`; forward, right and down are orthogonal unit vectors. Points in the
// view's frame are (depth, right, down) in mm relative to the target.
struct Camera {
  Vec3 target, forward{0, 1, 0}, right{1, 0, 0}, down{0, 0, -1};
  double height_mm = 100;  // height of the picture at the target
  double distance_mm = 0;  // distance of the eye from the target; 0 for infinity, an orthographic view

  bool is_orthographic() const { return distance_mm == 0; }
  Affine design_from_view() const;  // without perspective
  // Returns the factor between a length at this depth and its length in the picture plane.
  double stretch_at(double depth) const { return is_orthographic() ? 1 : (distance_mm + depth) / distance_mm; }
  // Projects a point of the picture plane (right, down) back to a depth; returns a point in the view's frame without
  // perspective.
  Vec3 unprojected(Vec3 view) const;
  Vec3 in_view(Vec3 design) const;  // the inverse map, from the design's space
};

struct ViewOptions {
  // direction of the eye: azimuth 0 is in front (at -y), 90 at +x; elevation is above the horizon
  double azimuth_deg = -35, elevation_deg = 25;
  double field_of_view_deg = 0;  // vertical; 0: orthographic
  double zoom = 1;               // magnifies the middle of the picture; the eye does not move
  // Target, and height of the picture there, of a view that stays fixed while the design changes. If they are not set,
  // the box determines them.
  std::optional<Vec3> target = std::nullopt;
  std::optional<double> height_mm = std::nullopt;
};

// Returns the view of a name: front, back, left, right, top, bottom or iso.
std::optional<ViewOptions> named_view(std::string_view name);
std::vector<std::string> view_names();

// Returns a camera whose picture of this aspect ratio (width over height) contains the whole box, unless the options
// say otherwise.
Camera camera_around(const Box& box, const ViewOptions& options, double aspect);

}  // namespace ombre::render
