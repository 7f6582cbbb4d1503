// The space above a patch of a surface as a field source.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/math/math.h"
#include "import/charts/prism_rows.h"
#include "import/charts/shell.h"
#include "import/charts/shell_prisms.h"
#include "import/fields/triangle_distance.h"

namespace ombre::importing {
namespace {

enum Channel {
  u_channel,
  v_channel,
  height_channel,
  first_slope,
  outside_channel = first_slope + 9,
  inside_channel,
  border_channel,
  channel_count
};

constexpr std::array<std::string_view, channel_count> channel_names{
    "u",   "v",        "height",   "u_x",      "u_y",     "u_z",    "v_x",   "v_y",
    "v_z", "height_x", "height_y", "height_z", "outside", "inside", "border"};

constexpr double on_border = -1e-12;       // shares of a point on the border of a prism, with rounding
constexpr double certainly_inside = 1e-7;  // least share at which no other prism holds a point
constexpr uint32_t none = no_triangle;
constexpr double least_outside = 1e-9;  // g where a point lies outside, at least
constexpr size_t most_in_range = 64;    // triangles whose ranges are joined; more have the range of all

Interval joined(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }

class ShellSource final : public program::NamedSource {
 public:
  ShellSource(std::string name, Shell shell, Hash content)
      : NamedSource(std::move(name), content), shell_(std::move(shell)), prisms_(shell_) {
    std::vector<Box> boxes;
    for (size_t n = 0; n < prisms_.count(); ++n) {
      boxes.push_back(prisms_[n].box({0, 0}));
      const Box box = prisms_[n].box(prisms_.heights());
      boxes_.push_back(box.expanded(1e-9 * length(box.size())));
      bounds_ = hull(bounds_, box);
    }
    triangles_ = BoxTree(boxes);
    for (const auto& [a, b, c] : shell_.patch.triangles) {
      const auto& places = shell_.patch.places;
      coordinates_.push_back({places[a], places[b] - places[a], places[c] - places[a]});
    }
    neighbours_ = neighbours_of(shell_.patch.triangles);
    make_border();
    make_ranges();
  }

  Box bounds() const override { return bounds_; }
  int channel(std::string_view channel_name) const override {
    const auto found = std::ranges::find(channel_names, channel_name);
    return found == channel_names.end() ? -1 : static_cast<int>(found - channel_names.begin());
  }
  double ops_of_sample(int channel) const override { return channel == inside_channel ? 50 : 150; }

  double sample(int channel, Vec3 p) const override {
    Guess guess;
    double found = 0;
    double* const where = &found;
    sample_one({&channel, 1}, p, guess, {&where, 1}, 0);
    return found;
  }
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override {
    double* const where = values.data();
    sample_channels({&channel, 1}, points, {&where, 1});
  }
  void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                       std::span<double* const> values) const override {
    Guess guess;
    static thread_local std::vector<uint32_t> candidates;
    if (list_candidates(points, candidates)) guess.candidates = &candidates;
    for (size_t n = 0; n < points.size();) {
      const size_t together = guess.is_inside ? sample_row(channels, points.subspan(n), guess.prism, values, n) : 0;
      n += together;
      if (together == PrismRow::most || n == points.size()) continue;
      sample_one(channels, points[n], guess, values, n);
      ++n;
    }
  }
  Interval range(int channel, const Box& box) const override {
    if (channel == outside_channel) return range_of_outside(box);
    if (channel == inside_channel) return range_of_inside(box);
    if (channel == border_channel) return {0, Box::inf};
    const Interval all = ranges_all_[static_cast<size_t>(channel)];
    if (!box.is_bounded()) return all;
    const Near& here = near(box);
    if (here.are_many || here.triangles.empty()) return all;
    Interval found{Box::inf, -Box::inf};
    for (const uint32_t n : here.triangles) found = joined(found, range_in(channel, n, box));
    return found;
  }

 private:
  // Triangles of which one gives the values at each point of a box: a point in a prism lies in that of one of them, and
  // points outside are nearest to one of them.
  struct Near {
    uint64_t of = 0;  // id of the source; 0: none
    Box box;
    bool are_many = false;  // and so not listed
    std::vector<uint32_t> triangles;
  };

  // Returns those of a box, of which a program asks all channels one after the other. Valid until this thread asks for
  // another box.
  const Near& near(const Box& box) const {
    static thread_local Near last;
    if (last.of == id_ && last.box == box) return last;
    last = {id_, box, true, {}};
    constexpr double largest = 6;  // in sizes of prisms; larger boxes meet too many
    if (length(box.size()) > largest * prisms_.mean_size()) return last;
    const double reach = length(box.size()) * (1 + 1e-9);
    const Vec3 middle = box.center();
    const double least = triangles_.nearest(middle, Box::inf, 0, [&](uint32_t n) { return distance_to(n, middle); });
    std::vector<uint32_t>& list = last.triangles;
    const auto take = [&](uint32_t n) {
      if (list.size() <= most_in_range && (list.empty() || list.back() != n)) list.push_back(n);
    };
    prisms_.each_near(box, take);
    triangles_.each_that_meets(Box{middle, middle}.expanded((least + reach) * (1 + 1e-9)), take);
    last.are_many = list.size() > most_in_range;
    return last;
  }

  struct Found {
    uint32_t prism = none;
    PrismPlace place;
    bool is_inside = false;
  };

  double distance_to(uint32_t n, Vec3 p) const {
    const auto [a, b, c] = shell_.patch.triangles[n];
    const auto& points = shell_.patch.points;
    return std::sqrt(squared_distance(p, {points[a], points[b], points[c]}));
  }

  // Triangles of the point before, which is probably near. They do not change what is found.
  struct Guess {
    uint32_t prism = none;    // holds it
    uint32_t nearest = none;  // is nearest to it
    bool is_inside = false;
    const std::vector<uint32_t>* candidates = nullptr;  // all prisms that may hold it; null: unknown
  };

  // Lists the prisms that may hold one of the points. Returns false if these are too many to test all of them.
  bool list_candidates(std::span<const Vec3> points, std::vector<uint32_t>& list) const {
    constexpr size_t most = 48;
    Box box;
    for (const Vec3 p : points)
      if (is_finite(p)) box = hull(box, Box{p, p});
    list.clear();
    prisms_.each_near(box, [&](uint32_t n) {
      if (list.size() <= 8 * most) list.push_back(n);
    });
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
    return list.size() <= most;
  }

  // Samples points at n in one prism, and returns how many of the first ones certainly lie in it.
  size_t sample_row(std::span<const int> channels, std::span<const Vec3> points, uint32_t prism,
                    std::span<double* const> values, size_t n) const {
    PrismRow row;  // NOLINT: what is read is set before
    const size_t count = std::min(points.size(), PrismRow::most);
    for (size_t i = 0; i < PrismRow::most; ++i) {
      const Vec3 p = points[std::min(i, count - 1)];
      row.x[i] = p.x;
      row.y[i] = p.y;
      row.z[i] = p.z;
    }
    const size_t found = find_places(prisms_[prism].numbers(), prisms_.heights(), certainly_inside, row, count);
    if (found == 0) return 0;
    if (std::ranges::any_of(channels, is_slope)) find_slopes(prisms_[prism].numbers(), row, found);
    for (size_t c = 0; c < channels.size(); ++c) take_row(channels[c], points.first(found), prism, row, values[c] + n);
    return found;
  }
  void take_row(int channel, std::span<const Vec3> points, uint32_t prism, const PrismRow& row, double* to) const {
    const auto& [place, first, second] = coordinates_[prism];
    const auto mix = [&](double from, double by_second, double by_third) {
      for (size_t i = 0; i < points.size(); ++i) to[i] = from + row.second[i] * by_second + row.third[i] * by_third;
    };
    if (channel == u_channel) return mix(place.x, first.x, second.x);
    if (channel == v_channel) return mix(place.y, first.y, second.y);
    if (!is_slope(channel)) {
      for (size_t i = 0; i < points.size(); ++i)
        to[i] = value(channel, points[i], {prism, {row.second[i], row.third[i], row.height[i]}, true}, {});
      return;
    }
    const auto axis = static_cast<size_t>(channel - first_slope) % 3;
    const int of = (channel - first_slope) / 3;
    for (size_t i = 0; i < points.size(); ++i)
      to[i] = of == 2 ? row.slopes[6 + axis][i]
                      : (of == 0 ? first.x : first.y) * row.slopes[axis][i] +
                            (of == 0 ? second.x : second.y) * row.slopes[3 + axis][i];
  }

  void sample_one(std::span<const int> channels, Vec3 p, Guess& guess, std::span<double* const> values,
                  size_t n) const {
    const bool needs_place = std::ranges::any_of(channels, [](int c) { return c != inside_channel; });
    Found found{0, {}, false};
    if (is_finite(p)) {
      found = find_prism(p, guess);
      if (!found.is_inside && needs_place) found = find_nearest(p, guess);
    }
    guess.is_inside = found.is_inside;
    const Prism::Slopes slopes = std::ranges::any_of(channels, is_slope) ? slopes_at(found) : Prism::Slopes();
    for (size_t c = 0; c < channels.size(); ++c) values[c][n] = value(channels[c], p, found, slopes);
  }

  // Returns the prism that holds the point: of several the first. Else `is_inside` is false, and nothing else is set.
  Found find_prism(Vec3 p, Guess& guess) const {
    if (const auto found = trace(p, guess.prism)) {
      guess.prism = found->prism;
      return *found;
    }
    Found found;
    const auto test = [&](uint32_t n) {
      PrismPlace place;
      if (n > found.prism || !prisms_[n].find(p, prisms_.heights(), place) || place.least_share() < on_border) return;
      found = {n, place, true};
    };
    if (guess.candidates) {
      for (const uint32_t n : *guess.candidates)
        if (boxes_[n].contains(p)) test(n);
    } else {
      prisms_.each_near(Box{p, p}, test);
    }
    if (found.is_inside) guess.prism = found.prism;
    return found;
  }
  // Goes from prism to prism towards the point. Returns nothing if it meets a border, or the point may lie in several.
  std::optional<Found> trace(Vec3 p, uint32_t from) const {
    constexpr int most_steps = 8;
    for (int step = 0; step < most_steps && from != none; ++step) {
      PrismPlace place;
      if (!prisms_[from].find(p, prisms_.heights(), place)) return std::nullopt;
      if (place.least_share() > certainly_inside) return Found{from, place, true};
      const std::array<double, 3> shares{place.first(), place.second, place.third};
      const auto least = std::ranges::min_element(shares);
      if (*least >= -certainly_inside) return std::nullopt;
      from = neighbours_[from][static_cast<size_t>(least - shares.begin())];
    }
    return std::nullopt;
  }

  // Returns the place of the nearest triangle: of several the first.
  Found find_nearest(Vec3 p, Guess& guess) const {
    // With this room, rounding does not decide whether triangles at the same distance are compared.
    constexpr double more = 1 + 1e-12;
    uint32_t nearest = guess.nearest;
    double best = nearest == none ? Box::inf : distance_to(nearest, p);
    triangles_.nearest(p, best * more, 0, [&](uint32_t n) {
      const double here = distance_to(n, p);
      if (here < best || (here == best && n < nearest)) {
        best = here;
        nearest = n;
      }
      return here * more;
    });
    guess.nearest = nearest;
    return {nearest, prisms_[nearest].nearest(p), false};
  }

  static bool is_slope(int channel) { return channel >= first_slope && channel < outside_channel; }
  Prism::Slopes slopes_at(const Found& found) const {
    PrismPlace inner = found.place;
    inner.height = std::clamp(inner.height, prisms_.heights().lo, prisms_.heights().hi);
    return prisms_[found.prism].slopes(inner);
  }
  double value(int channel, Vec3 p, const Found& found, const Prism::Slopes& slopes) const {
    if (channel == outside_channel) return outside(p, found);
    if (channel == border_channel)
      return from_side(p, std::clamp(found.place.height, shell_.heights.lo, shell_.heights.hi), Box::inf);
    if (channel == inside_channel) return found.is_inside && shell_.heights.contains(found.place.height) ? 1 : 0;
    if (channel == height_channel) return limited(found.place.height);
    const auto& [places, first, second] = coordinates_[found.prism];
    const PrismPlace& at = found.place;
    if (channel == u_channel) return places.x + at.second * first.x + at.third * second.x;
    if (channel == v_channel) return places.y + at.second * first.y + at.third * second.y;
    const int axis = (channel - first_slope) % 3;
    switch ((channel - first_slope) / 3) {
      case 0:
        return first.x * slopes.second[axis] + second.x * slopes.third[axis];
      case 1:
        return first.y * slopes.second[axis] + second.y * slopes.third[axis];
      default:
        return slopes.height[axis];
    }
  }
  // Heights far outside have no meaning, but a bound.
  double limited(double height) const {
    const double span = shell_.heights.hi - shell_.heights.lo;
    return std::clamp(height, shell_.heights.lo - span, shell_.heights.hi + span);
  }

  // Beside the shell, the distance from its side is measured at the height of the point. Above and below it, only the
  // ends count.
  double outside(Vec3 p, const Found& found) const {
    const double scale = length(prisms_[found.prism].way(found.place)), t = found.place.height;
    const Interval heights = shell_.heights;
    const double ends = scale * std::max(heights.lo - t, t - heights.hi);
    const double level = std::clamp(t, heights.lo, heights.hi);
    if (found.is_inside && ends >= 0) return ends;
    // Inside, the side counts where it is nearer than the ends.
    const double reach = found.is_inside ? -ends : Box::inf;
    if (found.is_inside && from_border_[found.prism] >= reach) return ends;
    if (!found.is_inside && ends >= 0 && !is_on_border(found)) return std::max(ends, least_outside);
    const double side = from_side(p, level, reach);
    return found.is_inside ? std::max(ends, -side) : std::max({ends, side, least_outside});
  }

  // Returns the distance to the border of the patch, moved to a height; infinity if it is above `reach`.
  double from_side(Vec3 p, double level, double reach) const {
    return border_tree_.nearest(p, reach, 0, [&](uint32_t n) {
      const Vec3 a = shell_.at(border_[n][0], level), b = shell_.at(border_[n][1], level);
      return std::sqrt(squared_distance_to_segment(p, a, b));
    });
  }

  // Returns whether a place that is the nearest one of the patch lies on its border.
  bool is_on_border(const Found& found) const {
    constexpr double none_of_it = 1e-12;
    const auto& corners = shell_.patch.triangles[found.prism];
    const std::array<double, 3> shares{found.place.first(), found.place.second, found.place.third};
    for (size_t n = 0; n < 3; ++n) {
      if (shares[n] > none_of_it) continue;
      const size_t second = (n + 1) % 3, third = (n + 2) % 3;
      const bool has_border = has_border_[corners[second]] && has_border_[corners[third]];
      if (has_border && neighbours_[found.prism][n] == none) return true;
      if (shares[second] <= none_of_it && has_border_[corners[third]]) return true;
      if (shares[third] <= none_of_it && has_border_[corners[second]]) return true;
    }
    return false;
  }

  void make_border() {
    border_ = border_of(shell_.patch.triangles);
    remove_seams(shell_.patch.points, border_);
    std::vector<Box> boxes;
    has_border_.resize(shell_.patch.points.size());
    for (const auto& edge : border_) {
      for (const uint32_t point : edge) has_border_[point] = true;
      Box box;
      for (const uint32_t point : edge)
        for (const double t : {shell_.heights.lo, shell_.heights.hi})
          box = hull(box, Box{shell_.at(point, t), shell_.at(point, t)});
      boxes.push_back(box.expanded(1e-9 * length(box.size())));
    }
    border_tree_ = BoxTree(boxes);
    for (size_t n = 0; n < prisms_.count(); ++n) {
      const Box box = prisms_[n].box(prisms_.heights());
      const double middle = border_tree_.nearest(box.center(), Box::inf, 0, [&](uint32_t edge) {
        return std::sqrt(ombre::squared_distance(box.center(), boxes[edge]));
      });
      from_border_.push_back(middle * (1 - 1e-9) - 0.5 * length(box.size()));
    }
    for (const Vec3& way : shell_.ways) longest_way_ = std::max(longest_way_, length(way));
  }

  void make_ranges() {
    constexpr int tested = 5;
    const Interval heights = prisms_.heights();
    double steepest = 0;
    for (uint32_t n = 0; n < prisms_.count(); ++n) {
      const auto shares = prisms_[n].slope_ranges(heights);
      const auto& [place, first, second] = coordinates_[n];
      std::array<Interval, 9> own;
      for (size_t axis = 0; axis < 3; ++axis) {
        const auto mixed = [&](double a, double b) {
          return math::add(math::multiply(a, shares[0][axis]), math::multiply(b, shares[1][axis]));
        };
        own[axis] = mixed(first.x, second.x);
        own[3 + axis] = mixed(first.y, second.y);
        own[6 + axis] = shares[2][axis];
      }
      slope_ranges_.push_back(own);
      for (int step = 0; step < tested; ++step) {
        const double t = heights.lo + (heights.hi - heights.lo) * step / (tested - 1);
        for (const PrismPlace& at : {PrismPlace{0, 0, t}, {1, 0, t}, {0, 1, t}})
          steepest = std::max(steepest, length(prisms_[n].slopes(at).height));
      }
    }
    constexpr double more = 1.5;  // allows for places between the tested ones
    lipschitz_ = more * (1 + longest_way_ * steepest);
    ranges_all_.fill({Box::inf, -Box::inf});
    for (uint32_t n = 0; n < prisms_.count(); ++n)
      for (int c = 0; c < outside_channel; ++c)
        ranges_all_[static_cast<size_t>(c)] =
            joined(ranges_all_[static_cast<size_t>(c)], range_in(c, n, Box::everything()));
  }

  // Returns the range of a channel over the places of a triangle.
  Interval range_in(int channel, uint32_t n, const Box& box) const {
    constexpr double room = 1e-9;
    if (channel >= first_slope) {
      const Interval range = slope_ranges_[n][static_cast<size_t>(channel - first_slope)];
      const double more = room * (std::abs(range.lo) + std::abs(range.hi));
      return {range.lo - more, range.hi + more};
    }
    if (channel == height_channel) {
      const Interval found = box.is_bounded() ? prisms_[n].heights_of(box) : Interval::everything();
      return {limited(found.lo) - room, limited(found.hi) + room};
    }
    const auto& [place, first, second] = coordinates_[n];
    const auto part = [&](Vec2 v) { return channel == u_channel ? v.x : v.y; };
    const double a = part(place), b = part(place + first), c = part(place + second);
    const double more = room * (1 + std::abs(a) + std::abs(b) + std::abs(c));
    return {std::min({a, b, c}) - more, std::max({a, b, c}) + more};
  }

  Interval range_of_outside(const Box& box) const {
    if (!box.is_bounded()) return Interval::everything();
    if (!prisms_.meets_any(box)) return {least_outside, Box::inf};
    // Inside, g changes by at most a known amount for each mm until it reaches 0.
    const double value = sample(outside_channel, box.center()), by = lipschitz_ * 0.5 * length(box.size());
    if (value + by < 0) return {value - by, value + by};
    return Interval::everything();
  }

  // A box is inside if its centre is, and none of its points lies on the sides, the bottom or the top.
  Interval range_of_inside(const Box& box) const {
    if (!box.is_bounded()) return {0, 1};
    if (!prisms_.meets_any(box)) return Interval(0);
    const Near& here = near(box);
    if (here.are_many) return {0, 1};
    Interval heights{Box::inf, -Box::inf};
    for (const uint32_t n : here.triangles) heights = joined(heights, prisms_[n].heights_of(box));
    if (heights.lo > shell_.heights.hi || heights.hi < shell_.heights.lo) return Interval(0);
    const bool is_between = heights.lo > shell_.heights.lo && heights.hi < shell_.heights.hi;
    return is_between && !border_tree_.meets_any(box) ? Interval(sample(inside_channel, box.center())) : Interval(0, 1);
  }

  // Returns a number of its own for each source.
  static uint64_t next_id() {
    static std::atomic<uint64_t> last{0};
    return ++last;
  }

  const uint64_t id_ = next_id();
  Shell shell_;
  Prisms prisms_;
  Box bounds_;
  std::vector<Box> boxes_;  // around each prism
  BoxTree triangles_, border_tree_;
  std::vector<std::array<uint32_t, 2>> border_;
  std::vector<bool> has_border_;     // by point
  std::vector<double> from_border_;  // by prism: all its points are at least so far from the border, mm
  double longest_way_ = 0, lipschitz_ = 1;
  std::vector<std::array<uint32_t, 3>>
      neighbours_;                                // by prism: the one beyond the edge opposite to each corner, or none
  std::vector<std::array<Vec2, 3>> coordinates_;  // by triangle: the place of its first corner, the ways to the others
  std::vector<std::array<Interval, 9>> slope_ranges_;
  std::array<Interval, outside_channel> ranges_all_;
};

}  // namespace

program::SourceField make_shell_source(const std::string& name, Shell shell, Hash content) {
  return std::make_shared<ShellSource>(name, std::move(shell), content);
}

}  // namespace ombre::importing
