// Paths as field sources.
#include "import/path_source.h"

#include <cmath>

#include "base/assert.h"
#include "import/segment_tree.h"

namespace ombre::importing {
namespace {

// Of a distance, relative to the numbers that it was computed from.
constexpr double path_rounding = 1e-12;

std::vector<LineSegment> segments_of(const std::vector<Vec3>& points) {
  std::vector<LineSegment> segments;
  for (size_t n = 1; n < points.size(); ++n) segments.push_back({points[n - 1], points[n]});
  return segments;
}

class PathSource final : public program::FieldSource {
 public:
  explicit PathSource(const std::vector<Vec3>& points)
      : content_(hash_bytes({reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Vec3)})),
        lines_(segments_of(points)) {}

  std::string name() const override { return "path"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return lines_.bounds(); }
  int channel(std::string_view channel_name) const override { return channel_name == "distance" ? 0 : -1; }
  double sample(int, Vec3 p) const override { return lines_.distance(p); }

  // A distance changes by no more than the way to the box's corners.
  Interval range(int, const Box& box) const override {
    if (!box.is_bounded()) return {0, Box::inf};
    const Vec3 center = box.center();
    const double value = lines_.distance(center), reach = 0.5 * length(box.size());
    const double room = reach + path_rounding * (reach + value + length(center) + length(bounds().size()));
    return {std::max(0.0, round_down(value - room)), round_up(value + room)};
  }

 private:
  Hash content_;
  SegmentTree lines_;
};

}  // namespace

program::SourceField make_path_source(const std::vector<Vec3>& points) {
  ASSERT(points.size() >= 2);
  return std::make_shared<PathSource>(points);
}

}  // namespace ombre::importing
