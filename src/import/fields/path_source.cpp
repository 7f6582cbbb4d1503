// Paths as field sources.
#include "import/fields/path_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/system/assert.h"
#include "import/fields/segment_tree.h"

namespace ombre::importing {
namespace {

// Rounding error of a distance, relative to the numbers that it is computed from.
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

// Distances in the box differ from that at its centre by at most half its diagonal.
Interval distance_range(const SegmentTree& lines, const Box& box) {
  if (!box.is_bounded()) return {0, Box::inf};
  const Vec3 center = box.center();
  const double value = lines.distance(center), reach = 0.5 * length(box.size());
  const double room = reach + path_rounding * (reach + value + length(center) + length(lines.bounds().size()));
  return {std::max(0.0, round_down(value - room)), round_up(value + room)};
}

// Calls answer(segments, n) for point n if the nearest segment is among a few known ones, else alone(n). Points that
// follow each other in the list should be close in space.
template <class Answer, class Alone>
void answer_all(const SegmentTree& tree, std::span<const Vec3> points, const Answer& answer, const Alone& alone) {
  constexpr size_t at_once = 4096, group = 32, most_segments = 48;
  const auto box_of = [&](size_t begin, size_t end) {
    Box box;
    for (size_t n = begin; n < end; ++n) box = hull(box, Box{points[n], points[n]});
    return box;
  };
  for (size_t begin = 0; begin < points.size(); begin += at_once) {
    const size_t end = std::min(points.size(), begin + at_once);
    const Box around = box_of(begin, end);
    const std::vector<LineSegment> all = around.is_bounded() ? tree.near(around) : std::vector<LineSegment>();
    for (size_t n = begin; n < end; n += group) {
      const size_t last = std::min(end, n + group);
      const std::vector<LineSegment> few = all.empty() ? all : near(all, box_of(n, last));
      if (few.empty() || few.size() > most_segments)
        for (size_t i = n; i < last; ++i) alone(i);
      else
        for (size_t i = n; i < last; ++i) answer(few, i);
    }
  }
}

double least_distance(const std::vector<LineSegment>& segments, Vec3 p) {
  double best = std::numeric_limits<double>::infinity();
  for (const LineSegment& segment : segments) best = std::min(best, squared_distance(segment, p));
  return std::sqrt(best);
}

// Returns the nearest segment; the first if several are equally near.
const LineSegment& nearest_of(const std::vector<LineSegment>& segments, Vec3 p) {
  double best = std::numeric_limits<double>::infinity();
  const LineSegment* found = segments.data();
  for (const LineSegment& segment : segments) {
    const double squared = squared_distance(segment, p);
    if (squared >= best) continue;
    best = squared;
    found = &segment;
  }
  return *found;
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
  double sample(int channel, Vec3 p) const override {
    return channel == 0 ? lines_.distance(p) : along(lines_.nearest(p), p);
  }
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override {
    answer_all(
        lines_, points,
        [&](const std::vector<LineSegment>& near, size_t n) {
          values[n] = channel == 0 ? least_distance(near, points[n]) : along(nearest_of(near, points[n]), points[n]);
        },
        [&](size_t n) { values[n] = sample(channel, points[n]); });
  }
  Interval range(int channel, const Box& box) const override {
    return channel == 0 ? distance_range(lines_, box) : Interval(0, 1);
  }

 private:
  double along(const LineSegment& segment, Vec3 p) const {
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
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override {
    answer_all(
        points_, points,
        [&](const std::vector<LineSegment>& near, size_t n) {
          values[n] =
              channel == 0 ? least_distance(near, points[n]) : static_cast<double>(nearest_of(near, points[n]).number);
        },
        [&](size_t n) { values[n] = sample(channel, points[n]); });
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
