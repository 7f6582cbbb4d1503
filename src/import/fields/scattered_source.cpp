// Values at scattered points as field sources.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/math/box_tree.h"
#include "import/fields/result_source.h"

namespace ombre::importing {
namespace {

constexpr size_t most_neighbours = 8;

struct Neighbour {
  double distance_mm = Box::inf;
  uint32_t point = 0;
  auto operator<=>(const Neighbour&) const = default;  // NOLINT(modernize-use-nullptr): clang 14 finds one in it
};

// The nearest points, ordered by distance, then by number.
struct Neighbours {
  std::array<Neighbour, most_neighbours> list{};
  size_t count = 0;
};

class ScatteredSource final : public program::NamedSource {
 public:
  ScatteredSource(std::string name, std::shared_ptr<const formats::Results> results, bool takes_nearest,
                  const OutsideRule& outside, const Hash& content)
      : NamedSource(std::move(name), content),
        results_(std::move(results)),
        takes_nearest_(takes_nearest),
        outside_(outside) {
    std::vector<Box> boxes;
    for (const Vec3& point : results_->points) {
      boxes.push_back({point, point});
      bounds_ = hull(bounds_, boxes.back());
    }
    tree_ = BoxTree(boxes);
    for (size_t f = 0; f < results_->fields.size(); ++f) add_field(f);
  }

  Box bounds() const override { return bounds_.expanded(outside_.within_mm); }
  int channel(std::string_view channel_name) const override {
    if (channel_name == "inside") return 0;
    for (size_t n = 0; n < channels_.size(); ++n)
      if (channel_name == channels_[n].name) return static_cast<int>(n + 1);
    return -1;
  }

  double sample(int channel, Vec3 p) const override {
    if (!is_finite(p)) return channel == 0 ? 0 : std::numeric_limits<double>::quiet_NaN();
    return value(channel, near_to(p));
  }
  void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                       std::span<double* const> values) const override {
    for (size_t n = 0; n < points.size(); ++n) {
      if (!is_finite(points[n])) {
        for (size_t c = 0; c < channels.size(); ++c) values[c][n] = sample(channels[c], points[n]);
        continue;
      }
      const Neighbours near = near_to(points[n]);
      for (size_t c = 0; c < channels.size(); ++c) values[c][n] = value(channels[c], near);
    }
  }

  // A mean lies between the least and the greatest value.
  Interval range(int channel, const Box&) const override {
    if (channel == 0) return {0, 1};
    const ScatteredChannel& which = channels_[static_cast<size_t>(channel - 1)];
    if (std::isinf(outside_.within_mm)) return which.range;
    if (outside_.kind != OutsideRule::Kind::value) return Interval::everything();
    return hull(which.range, Interval(outside_.value));
  }

 private:
  struct ScatteredChannel {
    std::string name;
    size_t field = 0, component = 0;
    Interval range;
  };

  void add_field(size_t f) {
    const formats::ResultField& field = results_->fields[f];
    for (size_t c = 0; c < field.components; ++c) {
      Interval range(Box::inf, -Box::inf);
      for (size_t n = c; n < field.values.size(); n += field.components) range = hull(range, Interval(field.values[n]));
      const double room = 1e-12 * std::max(std::abs(range.lo), std::abs(range.hi));
      channels_.push_back({result_channel_name(f, c), f, c, {range.lo - room, range.hi + room}});
    }
  }

  Neighbours near_to(Vec3 p) const {
    Neighbours near;
    const size_t wanted = takes_nearest_ ? 1 : std::min(most_neighbours, results_->points.size());
    tree_.nearest(p, Box::inf, -1, [&](uint32_t n) {
      const Neighbour here{length(p - results_->points[n]), n};
      const auto end = near.list.begin() + static_cast<ptrdiff_t>(near.count);
      const auto place = std::upper_bound(near.list.begin(), end, here);
      if (near.count < wanted) {
        std::move_backward(place, end, end + 1);
        *place = here;
        ++near.count;
      } else if (place != end) {
        std::move_backward(place, end - 1, end);
        *place = here;
      }
      return near.count < wanted ? Box::inf : near.list[wanted - 1].distance_mm;
    });
    return near;
  }

  double value(int channel, const Neighbours& near) const {
    const bool is_near = near.list[0].distance_mm <= outside_.within_mm;
    if (channel == 0) return is_near ? 1 : 0;
    if (!is_near)
      return outside_.kind == OutsideRule::Kind::value ? outside_.value : std::numeric_limits<double>::quiet_NaN();
    const ScatteredChannel& which = channels_[static_cast<size_t>(channel - 1)];
    const formats::ResultField& field = results_->fields[which.field];
    const auto at = [&](size_t n) { return field.values[near.list[n].point * field.components + which.component]; };
    // Weights are relative to that of the nearest point, so that they neither overflow nor underflow.
    const double least = near.list[0].distance_mm;
    if (least == 0 || near.count == 1) return at(0);
    double sum = 0, weights = 0;
    for (size_t n = 0; n < near.count; ++n) {
      const double share = least / near.list[n].distance_mm;
      sum += share * share * at(n);
      weights += share * share;
    }
    return sum / weights;
  }

  std::shared_ptr<const formats::Results> results_;
  bool takes_nearest_;
  OutsideRule outside_;
  Box bounds_;
  BoxTree tree_;
  std::vector<ScatteredChannel> channels_;
};

}  // namespace

program::SourceField make_scattered_source(std::string name, std::shared_ptr<const formats::Results> results,
                                           bool takes_nearest, const OutsideRule& outside, const Hash& content) {
  return std::make_shared<ScatteredSource>(std::move(name), std::move(results), takes_nearest, outside, content);
}

}  // namespace ombre::importing
