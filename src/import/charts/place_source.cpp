#include "import/charts/place_source.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/math/nearest_of_all.h"
#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

class PlaceSource final : public program::NamedSource {
 public:
  PlaceSource(std::string name, SurfacePatch patch, const Hash& content)
      : NamedSource(std::move(name), content), patch_(std::move(patch)) {
    std::vector<Box> boxes;
    for (uint32_t n = 0; n < patch_.triangles.size(); ++n) {
      boxes.push_back(box_of(corners(n)));
      mean_size_ += length(boxes.back().size()) / static_cast<double>(patch_.triangles.size());
    }
    tree_ = BoxTree(boxes);
    neighbours_ = neighbours_of(patch_.triangles);
    SurfacePatch flat = patch_;
    make_normals(flat);
    corner_normals_ = std::move(flat.normals);
    make_border();
    make_ranges();
  }

  Box bounds() const override { return Box::everything(); }
  int channel(std::string_view channel_name) const override {
    const auto found = std::ranges::find(channel_names, channel_name);
    return found == channel_names.end() ? -1 : static_cast<int>(found - channel_names.begin());
  }
  double ops_of_sample(int) const override { return 500; }

  double sample(int channel, Vec3 p) const override { return is_finite(p) ? value(channel, p, nearest(p)) : 0; }
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override {
    double* const where = values.data();
    sample_channels({&channel, 1}, points, {&where, 1});
  }
  void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                       std::span<double* const> values) const override {
    static thread_local Search search;
    search.points.clear();
    for (const Vec3 p : points)
      if (is_finite(p)) search.points.push_back(p);
    find_places(search);
    if (std::ranges::find(channels, static_cast<int>(border_channel)) != channels.end()) find_borders(search);
    for (size_t n = 0, found = 0; n < points.size(); ++n) {
      const bool is_place = is_finite(points[n]);
      for (size_t c = 0; c < channels.size(); ++c) {
        double& to = values[c][n];
        if (!is_place)
          to = 0;
        else if (channels[c] == border_channel)
          to = search.from_border[found];
        else
          to = value(channels[c], points[n], search.places[found]);
      }
      if (is_place) ++found;
    }
  }

  Interval range(int channel, const Box& box) const override {
    if (channel >= first_normal && channel < border_channel) return {-1, 1};
    if (channel == distance_channel) return box.is_bounded() ? range_of_distance(box) : Interval::everything();
    Interval found{Box::inf, -Box::inf};
    const auto add = [&](uint32_t n) { found = joined(found, range_in(channel, n)); };
    return box.is_bounded() && each_near(box, add) ? found : ranges_all_[static_cast<size_t>(channel)];
  }

 private:
  enum Channel {
    u_channel,
    v_channel,
    distance_channel,
    first_point,
    first_normal = first_point + 3,
    border_channel = first_normal + 3,
    channel_count
  };
  static constexpr std::array<std::string_view, channel_count> channel_names{
      "u", "v", "distance", "x", "y", "z", "normal_x", "normal_y", "normal_z", "border"};
  // The sizes of triangles around a box of which the range is found triangle by triangle; farther ones have that of
  // all.
  static constexpr double farthest_listed = 8;

  // A triangle without area has no direction.
  static Vec3 unit_of(Vec3 v) { return length(v) > 0 ? (1 / length(v)) * v : v; }

  // The nearest point of the patch.
  struct Place {
    double squared = Box::inf;  // mm^2
    uint32_t triangle = 0;
    std::array<double, 3> shares{};
  };

  std::array<Vec3, 3> corners(uint32_t triangle) const {
    const auto& [a, b, c] = patch_.triangles[triangle];
    return {patch_.points[a], patch_.points[b], patch_.points[c]};
  }
  Vec3 face_normal(uint32_t triangle) const {
    const auto [a, b, c] = corners(triangle);
    return unit_of(cross(b - a, c - a));
  }
  // The place that a thread found last, of the source with this id. The next one is probably near.
  struct Last {
    uint64_t of = 0;
    Vec3 p;
    Place place;
  };

  // Squared distances from points to triangles and to segments of the border.
  auto to_triangles() const {
    return [this](Vec3 p, uint32_t n) { return squared_distance(p, corners(n)); };
  }
  auto to_border() const {
    return [this](Vec3 p, uint32_t n) {
      return squared_distance_to_segment(p, patch_.points[border_[n][0]], patch_.points[border_[n][1]]);
    };
  }

  // Points that are sampled together, and what belongs to them.
  struct Search {
    NearestOfAll all;
    std::vector<Vec3> points, nearest_points;
    std::vector<NearestOfAll::Nearest> nearest;
    std::vector<Place> places;
    std::vector<double> from_border;  // mm
  };

  void find_places(Search& search) const {
    search.nearest.resize(search.points.size());
    search.all.find(tree_, search.points, to_triangles(), search.nearest);
    search.places.clear();
    for (size_t n = 0; n < search.points.size(); ++n)
      search.places.push_back(place_in(search.nearest[n], search.points[n]));
  }
  void find_borders(Search& search) const {
    search.nearest_points.clear();
    for (const Place& place : search.places) search.nearest_points.push_back(mean(patch_.points, place));
    search.all.find(border_tree_, search.nearest_points, to_border(), search.nearest);
    search.from_border.clear();
    for (const auto& [squared, segment] : search.nearest) search.from_border.push_back(std::sqrt(squared));
  }

  // Returns the nearest point, in the first of the nearest triangles.
  Place nearest(Vec3 p) const {
    static thread_local Last last;
    if (last.of == id_ && last.p == p) return last.place;
    const double reach = last.of == id_ ? length(p - mean(patch_.points, last.place)) * (1 + 1e-9) + 1e-9 : Box::inf;
    last = {id_, p, nearest_within(p, reach)};
    return last.place;
  }
  Place nearest_within(Vec3 p, double reach) const {
    return place_in(NearestOfAll::find_one(tree_, p, reach, to_triangles()), p);
  }
  Place place_in(const NearestOfAll::Nearest& triangle, Vec3 p) const {
    return {triangle.squared, triangle.number, nearest_shares(corners(triangle.number), p)};
  }

  double distance(Vec3 p) const { return std::sqrt(nearest(p).squared); }

  // Visits the triangles that may hold the nearest points of a box. Returns false if they may be too many.
  template <class Visit>
  bool each_near(const Box& box, const Visit& visit) const {
    const Vec3 middle = box.center();
    const double farthest = (distance(middle) + length(box.size())) * (1 + 1e-9) + 1e-9;
    if (farthest > farthest_listed * mean_size_) return false;
    return tree_.each_within(middle, farthest, [&](uint32_t n) {
      if (squared_distance(middle, corners(n)) <= farthest * farthest) visit(n);
      return true;
    });
  }

  Interval range_of_distance(const Box& box) const {
    const double reach = 0.5 * length(box.size()) + 1e-9, least = distance(box.center());
    const double most = least + reach;
    if (least <= reach) return {-most, most};
    bool meets_border = false, is_outer = true, is_inner = true;
    const bool is_listed = each_near(box, [&](uint32_t n) {
      meets_border |= at_border_[n];
      if (is_outer || is_inner) {
        const Interval side = side_of(box.center(), reach, n);
        is_outer &= side.lo > 0;
        is_inner &= side.hi < 0;
      }
    });
    if (!is_listed) return {-most, most};
    // Without a border, the side changes only where the surface lies between.
    if (!meets_border) (sample(distance_channel, box.center()) < 0 ? is_inner : is_outer) = true;
    return is_outer ? Interval(least - reach, most) : is_inner ? Interval(-most, reach - least) : Interval(-most, most);
  }
  // Returns the range of what decides the side of points within `reach` of p whose nearest point lies in a triangle: of
  // its heights above the planes that `normal_of_place` chooses from.
  Interval side_of(Vec3 p, double reach, uint32_t triangle) const {
    const auto t = corners(triangle);
    Interval found{Box::inf, -Box::inf};
    const auto add = [&](Vec3 normal, Vec3 q) {
      const double height = dot(p - q, normal), room = (reach + 1e-9) * length(normal);
      found = joined(found, {height - room, height + room});
    };
    const Vec3 own = face_normal(triangle);
    add(own, t[0]);
    for (size_t n = 0; n < 3; ++n) {
      add(corner_normals_[patch_.triangles[triangle][n]], t[n]);
      const uint32_t beyond = neighbours_[triangle][n];
      if (beyond == no_triangle) continue;
      const Vec3 sum = own + face_normal(beyond);
      for (size_t end = 0; end < 3; ++end)
        if (end != n) add(sum, t[end]);
    }
    return found;
  }

  // Returns the sum of values of the corners, weighted by the shares.
  template <class T>
  T mean(const std::vector<T>& of, const Place& at) const {
    const auto& [a, b, c] = patch_.triangles[at.triangle];
    return at.shares[0] * of[a] + at.shares[1] * of[b] + at.shares[2] * of[c];
  }

  double value(int channel, Vec3 p, const Place& at) const {
    if (channel == u_channel) return mean(patch_.places, at).x;
    if (channel == v_channel) return mean(patch_.places, at).y;
    if (channel == distance_channel) return std::copysign(std::sqrt(at.squared), side(p, at));
    if (channel < first_normal) return mean(patch_.points, at)[channel - first_point];
    if (channel < border_channel) return smooth_normal(at)[channel - first_normal];
    return from_border(mean(patch_.points, at));
  }
  Vec3 smooth_normal(const Place& at) const {
    const Vec3 normal = mean(patch_.normals, at);
    return length(normal) > 0 ? unit_of(normal) : face_normal(at.triangle);
  }

  // Returns a number that is negative if p lies on the inner side.
  double side(Vec3 p, const Place& at) const {
    const double found = dot(p - mean(patch_.points, at), normal_of_place(at));
    return found < 0 ? -1 : 1;
  }
  Vec3 normal_of_place(const Place& at) const {
    const Corners& t = patch_.triangles[at.triangle];
    for (size_t n = 0; n < 3; ++n)
      if (at.shares[n] == 1) return corner_normals_[t[n]];
    Vec3 sum = face_normal(at.triangle);
    for (size_t n = 0; n < 3; ++n) {
      const uint32_t beyond = neighbours_[at.triangle][n];
      if (at.shares[n] == 0 && beyond != no_triangle) sum = sum + face_normal(beyond);
    }
    return sum;
  }

  double from_border(Vec3 q) const {
    return std::sqrt(NearestOfAll::find_one(border_tree_, q, Box::inf, to_border()).squared);
  }

  void make_border() {
    const auto edges = border_of(patch_.triangles);
    std::vector<bool> is_on_border(patch_.points.size());
    for (const auto& edge : edges)
      for (const uint32_t point : edge) is_on_border[point] = true;
    for (const Corners& t : patch_.triangles)
      at_border_.push_back(is_on_border[t[0]] || is_on_border[t[1]] || is_on_border[t[2]]);
    border_ = edges;
    remove_seams(patch_.points, border_);
    if (border_.empty()) border_ = edges;  // a pipe that is cut open, whose ends are closed
    std::vector<Box> boxes;
    for (const auto& [a, b] : border_)
      boxes.push_back(hull({patch_.points[a], patch_.points[a]}, {patch_.points[b], patch_.points[b]}));
    border_tree_ = BoxTree(boxes);
    for (uint32_t n = 0; n < patch_.triangles.size(); ++n) {
      const auto [a, b, c] = corners(n);
      const Vec3 middle = (1.0 / 3) * (a + b + c);
      const double room = std::max({length(a - middle), length(b - middle), length(c - middle)}) * (1 + 1e-9) + 1e-9;
      const double distance = from_border(middle);
      from_border_.push_back({std::max(0.0, distance - room), distance + room});
    }
  }

  void make_ranges() {
    for (int channel = 0; channel < channel_count; ++channel) {
      if (channel >= first_normal && channel < border_channel) continue;
      Interval& all = ranges_all_[static_cast<size_t>(channel)];
      all = {Box::inf, -Box::inf};
      for (uint32_t n = 0; n < patch_.triangles.size(); ++n) all = joined(all, range_in(channel, n));
    }
  }

  static Interval joined(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }
  // Returns the range of a channel over the places of a triangle: a coordinate, a coordinate of points, or the border.
  Interval range_in(int channel, uint32_t n) const {
    if (channel == border_channel) return from_border_[n];
    Interval found{Box::inf, -Box::inf};
    for (const uint32_t corner : patch_.triangles[n]) {
      const Vec2 place = patch_.places[corner];
      const double here = channel == u_channel   ? place.x
                          : channel == v_channel ? place.y
                                                 : patch_.points[corner][channel - first_point];
      const double more = 1e-9 * (1 + std::abs(here));
      found = joined(found, {here - more, here + more});
    }
    return found;
  }

  // Returns a number of its own for each source.
  static uint64_t next_id() {
    static std::atomic<uint64_t> last{0};
    return ++last;
  }

  const uint64_t id_ = next_id();
  SurfacePatch patch_;
  double mean_size_ = 0;  // of triangles, mm
  BoxTree tree_, border_tree_;
  std::vector<std::array<uint32_t, 3>> neighbours_;  // by triangle: the one beyond the edge opposite to each corner
  std::vector<Vec3> corner_normals_;                 // by point: weighted by the angles of its triangles
  std::vector<bool> at_border_;                      // by triangle: has a corner on the border
  std::vector<std::array<uint32_t, 2>> border_;
  std::vector<Interval> from_border_;               // by triangle: distances of its points from the border, mm
  std::array<Interval, channel_count> ranges_all_;  // of coordinates, of points and of the distance from the border
};

}  // namespace

program::SourceField make_place_source(std::string name, SurfacePatch patch, const Hash& content) {
  return std::make_shared<PlaceSource>(std::move(name), std::move(patch), content);
}

}  // namespace ombre::importing
