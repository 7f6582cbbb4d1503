// Transforms surfaces to the space of a perspective.
#include "import/surfaces/perspective.h"

namespace ombre::importing {
namespace {

// Distance from the eye below which surfaces are cut off, as a share of the distance from the eye to the picture plane.
constexpr double nearest = 1.0 / 200;

class Viewer {
 public:
  Viewer(const Surface& surface, const program::RayLattice& rays, const Affine& source_from_view)
      : surface_(surface), rays_(rays) {
    const Affine view_from_source = inverse(source_from_view);
    for (const Vec3& vertex : surface.vertices) {
      in_view_.push_back(view_from_source(vertex));
      is_seen_.push_back(shrinking(in_view_.back()) > nearest);
      seen_.vertices.push_back(is_seen_.back() ? projected(in_view_.back()) : Vec3{});
    }
  }

  Surface take() {
    for (const auto& triangle : surface_.triangles) add(triangle);
    return std::move(seen_);
  }

 private:
  double shrinking(Vec3 view) const { return (rays_.eye_mm + view.x) / rays_.eye_mm; }
  Vec3 projected(Vec3 view) const {
    const double s = shrinking(view);
    return {view.x / s, (view.y / s - rays_.first.y) / rays_.step.y, (view.z / s - rays_.first.z) / rays_.step.z};
  }

  // Adds the visible part of a triangle, with the same orientation.
  void add(const std::array<uint32_t, 3>& triangle) {
    std::array<uint32_t, 4> corners{};
    size_t count = 0;
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t here = triangle[i], next = triangle[(i + 1) % 3];
      if (is_seen_[here]) corners[count++] = here;
      if (is_seen_[here] != is_seen_[next]) corners[count++] = cut(here, next);
    }
    for (size_t i = 2; i < count; ++i) seen_.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }

  // Returns the vertex at which an edge leaves the view; both of its triangles get the same one.
  uint32_t cut(uint32_t a, uint32_t b) {
    const Vec3 from = in_view_[std::min(a, b)], to = in_view_[std::max(a, b)];
    const double depth = (nearest - 1) * rays_.eye_mm, t = (depth - from.x) / (to.x - from.x);
    Vec3 at = from + t * (to - from);
    at.x = depth;
    seen_.vertices.push_back(projected(at));
    return static_cast<uint32_t>(seen_.vertices.size() - 1);
  }

  const Surface& surface_;
  const program::RayLattice& rays_;
  std::vector<Vec3> in_view_;
  std::vector<char> is_seen_;
  Surface seen_;
};

}  // namespace

Surface seen_in_perspective(const Surface& surface, const program::RayLattice& rays, const Affine& source_from_view) {
  return Viewer(surface, rays, source_from_view).take();
}

}  // namespace ombre::importing
