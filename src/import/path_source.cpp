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
  for (size_t n = 1; n < points.size(); ++n)
    segments.push_back({points[n - 1], points[n], static_cast<uint32_t>(segments.size())});
  return segments;
}

std::vector<LineSegment> points_as_segments(const std::vector<Vec3>& points) {
  std::vector<LineSegment> segments;
  for (const Vec3& point : points) segments.push_back({point, point, static_cast<uint32_t>(segments.size())});
  return segments;
}

Hash content_of(std::string_view kind, const std::vector<Vec3>& points) {
  std::string bytes(kind);
  bytes.append(reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Vec3));
  return hash_bytes(bytes);
}

// A distance changes by no more than the way to the box's corners.
Interval distance_range(const SegmentTree& lines, const Box& box) {
  if (!box.is_bounded()) return {0, Box::inf};
  const Vec3 center = box.center();
  const double value = lines.distance(center), reach = 0.5 * length(box.size());
  const double room = reach + path_rounding * (reach + value + length(center) + length(lines.bounds().size()));
  return {std::max(0.0, round_down(value - room)), round_up(value + room)};
}

class PathSource final : public program::FieldSource {
 public:
  explicit PathSource(const std::vector<Vec3>& points)
      : content_(content_of("path", points)), lines_(segments_of(points)), before_(points.size(), 0) {
    for (size_t n = 1; n < points.size(); ++n) before_[n] = before_[n - 1] + length(points[n] - points[n - 1]);
  }

  std::string name() const override { return "path"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return lines_.bounds(); }
  int channel(std::string_view channel_name) const override {
    return channel_name == "distance" ? 0 : channel_name == "along" ? 1 : -1;
  }
  double sample(int channel, Vec3 p) const override { return channel == 0 ? lines_.distance(p) : along(p); }
  Interval range(int channel, const Box& box) const override {
    return channel == 0 ? distance_range(lines_, box) : Interval(0, 1);
  }

 private:
  double along(Vec3 p) const {
    const LineSegment& segment = lines_.nearest(p);
    const double from = before_[segment.number], to = before_[segment.number + 1], whole = before_.back();
    return whole > 0 ? std::clamp((from + nearest_share(segment, p) * (to - from)) / whole, 0.0, 1.0) : 0;
  }

  Hash content_;
  SegmentTree lines_;
  std::vector<double> before_;  // length of the path up to each point
};

class PointsSource final : public program::FieldSource {
 public:
  explicit PointsSource(const std::vector<Vec3>& points)
      : content_(content_of("points", points)), count_(points.size()), points_(points_as_segments(points)) {}

  std::string name() const override { return "points"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return points_.bounds(); }
  int channel(std::string_view channel_name) const override {
    return channel_name == "distance" ? 0 : channel_name == "index" ? 1 : -1;
  }
  double sample(int channel, Vec3 p) const override {
    return channel == 0 ? points_.distance(p) : static_cast<double>(points_.nearest(p).number);
  }
  Interval range(int channel, const Box& box) const override {
    return channel == 0 ? distance_range(points_, box) : Interval(0, static_cast<double>(count_ - 1));
  }

 private:
  Hash content_;
  size_t count_;
  SegmentTree points_;
};

}  // namespace

program::SourceField make_path_source(const std::vector<Vec3>& points) {
  ASSERT(points.size() >= 2);
  return std::make_shared<PathSource>(points);
}

program::SourceField make_points_source(const std::vector<Vec3>& points) {
  ASSERT(!points.empty());
  return std::make_shared<PointsSource>(points);
}

}  // namespace ombre::importing
