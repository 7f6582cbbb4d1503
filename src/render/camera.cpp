#include "render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ombre::render {
namespace {

constexpr double border = 1.08;  // ratio of the picture's size to the part's

struct NamedView {
  std::string_view name;
  double azimuth_deg, elevation_deg;
};
constexpr NamedView named_views[] = {{"iso", -35, 25}, {"front", 0, 0}, {"back", 180, 0},  {"left", -90, 0},
                                     {"right", 90, 0}, {"top", 0, 90},  {"bottom", 0, -90}};

std::array<Vec3, 8> corners(const Box& box) {
  std::array<Vec3, 8> points;
  for (size_t n = 0; n < points.size(); ++n)
    points[n] = {n & 1 ? box.hi.x : box.lo.x, n & 2 ? box.hi.y : box.lo.y, n & 4 ? box.hi.z : box.lo.z};
  return points;
}

// Returns the height that shows all corners of the box from the camera's distance.
double height_for(const Camera& camera, const Box& box, double aspect) {
  double height = 0;
  for (const Vec3 corner : corners(box)) {
    const Vec3 p = camera.in_view(corner);
    height = std::max({height, 2 * std::abs(p.z), 2 * std::abs(p.y) / aspect});
  }
  return height;
}

}  // namespace

Affine Camera::design_from_view() const {
  Affine map;
  for (int axis = 0; axis < 3; ++axis) map.rows[static_cast<size_t>(axis)] = {forward[axis], right[axis], down[axis]};
  map.offset = target;
  return map;
}

Vec3 Camera::unprojected(Vec3 view) const {
  const double stretch = stretch_at(view.x);
  return {view.x, view.y * stretch, view.z * stretch};
}

Vec3 Camera::in_view(Vec3 design) const {
  const Vec3 p = design - target;
  const double depth = dot(p, forward), stretch = stretch_at(depth);
  return {depth, dot(p, right) / stretch, dot(p, down) / stretch};
}

std::optional<ViewOptions> named_view(std::string_view name) {
  for (const NamedView& view : named_views) {
    if (view.name != name) continue;
    ViewOptions options;
    options.azimuth_deg = view.azimuth_deg;
    options.elevation_deg = view.elevation_deg;
    return options;
  }
  return std::nullopt;
}

std::vector<std::string> view_names() {
  std::vector<std::string> names;
  for (const NamedView& view : named_views) names.emplace_back(view.name);
  return names;
}

Camera camera_around(const Box& box, const ViewOptions& options, double aspect) {
  Camera camera;
  camera.target = options.target.value_or(box.center());
  // The eye stands at -y, turns around z, then rises.
  const Affine turn =
      Affine::rotation({0, 0, 1}, options.azimuth_deg) * Affine::rotation({1, 0, 0}, -options.elevation_deg);
  camera.forward = turn.linear({0, 1, 0});
  camera.right = turn.linear({1, 0, 0});
  camera.down = turn.linear({0, 0, -1});
  // Radius of the ball around the target that contains the box.
  const double radius = length(box.size()) / 2 + length(box.center() - camera.target);
  if (options.field_of_view_deg > 0) {
    const double half = options.field_of_view_deg * 3.14159265358979323846 / 360;
    // The whole ball around the box is in view from this distance.
    camera.distance_mm = std::max(radius / std::sin(half), 1.01 * radius);
  }
  camera.height_mm = options.height_mm.value_or(border * height_for(camera, box, aspect)) / options.zoom;
  return camera;
}

}  // namespace ombre::render
