// Paths as field sources.
#include "import/fields/path_source.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/box_tree.h"
#include "base/math/segment_sets.h"
#include "base/system/assert.h"
#include "base/text/text.h"
#include "import/fields/segment_tree.h"
#include "import/fields/triangle_distance.h"

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

// Has the channel "distance", and another one that the nearest segment determines.
class NearestSegment : public program::FieldSource {
 public:
  NearestSegment(const char* name, const char* other_name, const std::vector<Vec3>& points,
                 std::vector<LineSegment> segments)
      : name_(name), other_(other_name), content_(content_of(name, points)), segments_(std::move(segments)) {}

  std::string name() const override { return name_; }
  Hash content() const override { return content_; }
  Box bounds() const override { return segments_.bounds(); }
  int channel(std::string_view channel_name) const override {
    return channel_name == "distance" ? 0 : channel_name == other_ ? 1 : -1;
  }
  double sample(int channel, Vec3 p) const override {
    return channel == 0 ? segments_.distance(p) : other(segments_.nearest(p), p);
  }
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override {
    answer_all(
        segments_, points,
        [&](const std::vector<LineSegment>& near, size_t n) {
          values[n] = channel == 0 ? least_distance(near, points[n]) : other(nearest_of(near, points[n]), points[n]);
        },
        [&](size_t n) { values[n] = sample(channel, points[n]); });
  }
  Interval range(int channel, const Box& box) const override {
    return channel == 0 ? distance_range(segments_, box) : other_range();
  }

 private:
  virtual double other(const LineSegment& nearest, Vec3 p) const = 0;
  virtual Interval other_range() const = 0;

  const char *name_, *other_;
  Hash content_;
  SegmentTree segments_;
};

class PathSource final : public NearestSegment {
 public:
  explicit PathSource(const std::vector<Vec3>& points)
      : NearestSegment("path", "along", points, segments_of(points)), before_(points.size(), 0) {
    for (size_t n = 1; n < points.size(); ++n) before_[n] = before_[n - 1] + length(points[n] - points[n - 1]);
  }

 private:
  double other(const LineSegment& segment, Vec3 p) const override {
    const double from = before_[segment.number], to = before_[segment.number + 1], whole = before_.back();
    return whole > 0 ? std::clamp((from + nearest_share(segment, p) * (to - from)) / whole, 0.0, 1.0) : 0;
  }
  Interval other_range() const override { return {0, 1}; }

  std::vector<double> before_;  // length of the path up to each point
};

class PointsSource final : public NearestSegment {
 public:
  explicit PointsSource(const std::vector<Vec3>& points)
      : NearestSegment("points", "index", points, points_as_segments(points)), count_(points.size()) {}

 private:
  double other(const LineSegment& point, Vec3) const override { return point.number; }
  Interval other_range() const override { return {0, static_cast<double>(count_ - 1)}; }

  size_t count_;
};

class SegmentsSource final : public NearestSegment {
 public:
  explicit SegmentsSource(const std::vector<Vec3>& points)
      : NearestSegment("segments", "index", points, pairs_of(points)), count_(points.size() / 2) {}

 private:
  static std::vector<LineSegment> pairs_of(const std::vector<Vec3>& points) {
    std::vector<LineSegment> segments;
    for (size_t n = 1; n < points.size(); n += 2)
      segments.push_back({points[n - 1], points[n], static_cast<uint32_t>(n / 2)});
    return segments;
  }
  double other(const LineSegment& segment, Vec3) const override { return segment.number; }
  Interval other_range() const override { return {0, static_cast<double>(count_ - 1)}; }

  size_t count_;
};

// Has the channel "distance", which changes by at most 1 mm for each mm.
class DistanceSource : public program::FieldSource {
 public:
  DistanceSource(const char* name, const std::vector<Vec3>& points) : name_(name), content_(content_of(name, points)) {}

  std::string name() const override { return name_; }
  Hash content() const override { return content_; }
  int channel(std::string_view channel_name) const override { return channel_name == "distance" ? 0 : -1; }
  double ops_of_sample(int) const override { return 100; }
  double sample(int, Vec3 p) const override { return is_finite(p) ? distance(p) : 0; }
  Interval range(int, const Box& box) const override {
    if (!box.is_bounded()) return {0, Box::inf};
    const double value = distance(box.center()), reach = 0.5 * length(box.size());
    const double room = reach + path_rounding * (reach + value + length(box.center()) + 1);
    return {std::max(0.0, round_down(value - room)), round_up(value + room)};
  }

 private:
  virtual double distance(Vec3 p) const = 0;

  const char* name_;
  Hash content_;
};

// Segments whose distances are joined with fillets.
class FilletedSegments final : public program::FieldSource {
 public:
  FilletedSegments(const std::vector<Vec3>& points, double reach)
      : content_(content_of("fillets " + format_number(reach), points)), reach_(reach) {
    for (size_t n = 0; n + 1 < points.size(); n += 2)
      segments_.push_back({points[n], points[n + 1], static_cast<uint32_t>(n / 2)});
    std::vector<Box> boxes;
    std::vector<Edge3> edges;
    for (const auto& [from, to, number] : segments_) {
      edges.push_back({from, to});
      boxes.push_back(hull(Box{from, from}, Box{to, to}));
      bounds_ = hull(bounds_, boxes.back());
    }
    tree_ = BoxTree(boxes);
    most_ = reach * std::sqrt(static_cast<double>(most_within(edges, reach)));
  }

  std::string name() const override { return "segments with fillets"; }
  Hash content() const override { return content_; }
  Box bounds() const override { return bounds_; }
  int channel(std::string_view channel_name) const override { return channel_name == "distance" ? 0 : -1; }
  double ops_of_sample(int) const override { return 150; }
  double sample(int, Vec3 p) const override {
    if (!is_finite(p)) return 0;
    const double influence = influences(Box{p, p}, 0).lo;
    return influence > 0 ? reach_ - influence : nearest(p);
  }
  Interval range(int, const Box& box) const override {
    if (!box.is_bounded()) return {-most_, Box::inf};
    const double half = 0.5 * length(box.size()), middle = nearest(box.center());
    const double room = path_rounding * (half + middle + most_ + length(box.center()) + length(bounds_.size()));
    const Interval by = half < 4 * reach_ ? influences(box, half) : Interval{0, most_};
    // The distance with fillets is never above that to the nearest segment.
    const double least = by.hi > 0 ? reach_ - by.hi : std::max(reach_, middle - half);
    const double greatest = by.lo > 0 ? std::min(middle + half, reach_ - by.lo) : middle + half;
    return {round_down(least - room), round_up(greatest + room)};
  }

 private:
  double nearest(Vec3 p) const {
    return tree_.nearest(p, Box::inf, 0, [&](uint32_t n) { return std::sqrt(squared_distance(segments_[n], p)); });
  }
  // Returns the range of sqrt(sum of (reach - d)^2) for points that are at most `half` away from the middle of the box.
  Interval influences(const Box& box, double half) const {
    double least = 0, greatest = 0;
    tree_.each_that_meets(box.expanded(reach_), [&](size_t n) {
      const double d = std::sqrt(squared_distance(segments_[n], box.center()));
      const double far = std::max(0.0, reach_ - d - half), near = std::max(0.0, reach_ - std::max(0.0, d - half));
      least += far * far;
      greatest += near * near;
    });
    return {std::sqrt(least), std::sqrt(greatest)};
  }

  Hash content_;
  double reach_ = 0, most_ = 0;
  std::vector<LineSegment> segments_;
  BoxTree tree_;
  Box bounds_;
};

// A point is as far from the wall between its cell and another one as from the plane between both points. A point b
// whose plane is w away is at most 2 w farther than the nearest point a: the foot of the perpendicular on the plane is
// as far from b as from a. So a search for the least |p - a| + 2 w never skips the nearest wall.
class PointCells final : public DistanceSource {
 public:
  explicit PointCells(const std::vector<Vec3>& points) : DistanceSource("cells of points", points), points_(points) {
    std::vector<Box> boxes;
    for (const Vec3& p : points) boxes.push_back({p, p});
    tree_ = BoxTree(boxes);
  }
  Box bounds() const override { return Box::everything(); }

 private:
  double distance(Vec3 p) const override {
    uint32_t own = 0;
    double least = Box::inf;
    tree_.nearest(p, Box::inf, 0, [&](uint32_t n) {
      const double here = length(points_[n] - p);
      if (here < least) {
        least = here;
        own = n;
      }
      return here;
    });
    const double found = tree_.nearest(p, Box::inf, 0, [&](uint32_t n) {
      const Vec3 apart = points_[n] - points_[own];
      const double size = length(apart);
      if (!(size > 0)) return Box::inf;
      return least + 2 * std::max(0.0, dot(0.5 * (points_[n] + points_[own]) - p, apart) / size);
    });
    return 0.5 * (found - least);
  }

  std::vector<Vec3> points_;
  BoxTree tree_;
};

class Triangles final : public DistanceSource {
 public:
  explicit Triangles(const std::vector<Vec3>& points) : DistanceSource("triangles", points) {
    std::vector<Box> boxes;
    for (size_t n = 0; n + 2 < points.size(); n += 3) {
      corners_.push_back({points[n], points[n + 1], points[n + 2]});
      boxes.push_back(box_of(corners_.back()));
      bounds_ = hull(bounds_, boxes.back());
    }
    tree_ = BoxTree(boxes);
  }
  Box bounds() const override { return bounds_; }

 private:
  double distance(Vec3 p) const override {
    return tree_.nearest(p, Box::inf, 0, [&](uint32_t n) { return std::sqrt(squared_distance(p, corners_[n])); });
  }

  std::vector<std::array<Vec3, 3>> corners_;
  Box bounds_;
  BoxTree tree_;
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

program::SourceField make_segments_source(const std::vector<Vec3>& points) {
  ASSERT(points.size() >= 2 && points.size() / 2 * 2 == points.size());
  return std::make_shared<SegmentsSource>(points);
}

program::SourceField make_filleted_source(const std::vector<Vec3>& points, double reach) {
  ASSERT(points.size() >= 2 && points.size() / 2 * 2 == points.size() && reach > 0);
  return std::make_shared<FilletedSegments>(points, reach);
}

program::SourceField make_triangles_source(const std::vector<Vec3>& points) {
  ASSERT(points.size() >= 3 && points.size() / 3 * 3 == points.size());
  return std::make_shared<Triangles>(points);
}

program::SourceField make_point_cells_source(const std::vector<Vec3>& points) {
  ASSERT(points.size() >= 2);
  return std::make_shared<PointCells>(points);
}

}  // namespace ombre::importing
