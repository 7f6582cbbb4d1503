#include "import/fields/result_source.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <map>

namespace ombre::importing {
namespace {

const Interval no_values(Box::inf, -Box::inf);

struct ResultChannel {
  size_t field = 0, component = 0;
};

// Bounds of one channel in the cells of a coarse grid.
class ChannelBounds {
 public:
  ChannelBounds(const ResultMesh& mesh, const formats::ResultField& field, size_t component) : bounds_(mesh.bounds()) {
    constexpr double most_along = 32;
    const double count = std::cbrt(static_cast<double>(mesh.element_count()));
    along_ = static_cast<int64_t>(std::clamp(count, 1.0, most_along));
    cells_.assign(static_cast<size_t>(along_ * along_ * along_), no_values);
    for (size_t n = 0; n < mesh.element_count(); ++n) {
      const Interval values = mesh.value_bounds(field, component, n);
      whole_ = hull(whole_, values);
      each_cell(mesh.element_bounds(n), [&](size_t cell) { cells_[cell] = hull(cells_[cell], values); });
    }
  }

  // Returns the bounds in a box, or an empty interval if the box does not meet the mesh.
  Interval over(const Box& box) const {
    Interval found = no_values;
    if (!meet(box, bounds_)) return found;
    if (box.contains(bounds_.lo) && box.contains(bounds_.hi)) return whole_;
    each_cell(box, [&](size_t cell) { found = hull(found, cells_[cell]); });
    return found;
  }

 private:
  template <class Visit>
  void each_cell(const Box& box, const Visit& visit) const {
    std::array<int64_t, 3> lo{}, hi{};
    for (int axis = 0; axis < 3; ++axis) {
      lo[static_cast<size_t>(axis)] = place(box.lo[axis], axis);
      hi[static_cast<size_t>(axis)] = place(box.hi[axis], axis);
    }
    for (int64_t k = lo[2]; k <= hi[2]; ++k)
      for (int64_t j = lo[1]; j <= hi[1]; ++j)
        for (int64_t i = lo[0]; i <= hi[0]; ++i) visit(static_cast<size_t>((k * along_ + j) * along_ + i));
  }
  int64_t place(double at, int axis) const {
    const double width = bounds_.hi[axis] - bounds_.lo[axis], count = static_cast<double>(along_);
    const double cell = width > 0 ? std::floor((at - bounds_.lo[axis]) / width * count) : 0;
    return static_cast<int64_t>(std::clamp(cell, 0.0, count - 1));
  }

  Box bounds_;
  int64_t along_ = 1;
  std::vector<Interval> cells_;
  Interval whole_ = no_values;
};

class ResultSource final : public program::NamedSource {
 public:
  ResultSource(std::string name, std::shared_ptr<const ResultMesh> mesh, const OutsideRule& outside,
               const Hash& content)
      : NamedSource(std::move(name), content), mesh_(std::move(mesh)), outside_(outside) {
    const auto& fields = mesh_->results().fields;
    for (size_t f = 0; f < fields.size(); ++f)
      for (size_t c = 0; c < fields[f].components; ++c) channels_.push_back({f, c});
  }

  Box bounds() const override { return mesh_->bounds(); }

  int channel(std::string_view channel_name) const override {
    if (channel_name == "inside") return inside_channel_number;
    for (size_t n = 0; n < channels_.size(); ++n)
      if (channel_name == result_channel_name(channels_[n].field, channels_[n].component))
        return static_cast<int>(n + 1);
    return -1;
  }

  double sample(int channel, Vec3 p) const override {
    double value = 0;
    double* const values = &value;
    sample_channels({&channel, 1}, {&p, 1}, {&values, 1});
    return value;
  }
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override {
    double* const rows = values.data();
    sample_channels({&channel, 1}, points, {&rows, 1});
  }

  void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                       std::span<double* const> values) const override {
    bool needs_values = false, needs_nodes = false;
    for (const int channel : channels) {
      if (channel == inside_channel_number) continue;
      needs_values = true;
      needs_nodes = needs_nodes || !mesh_->results().fields[of(channel).field].is_of_elements;
    }
    ResultMesh::Weights weights{};
    std::optional<ElementPlace> last;
    uint32_t last_triangle = UINT32_MAX;
    for (size_t n = 0; n < points.size(); ++n) {
      const auto held = mesh_->place(points[n], last ? &*last : nullptr);
      if (held) last = held;
      const auto place = held || !needs_values ? held : outside(points[n], last_triangle);
      if (place && needs_nodes) mesh_->find_weights(*place, weights);
      for (size_t c = 0; c < channels.size(); ++c)
        values[c][n] = channels[c] == inside_channel_number ? (held ? 1 : 0)
                       : place                              ? value(channels[c], place->element, weights)
                                                            : value_outside(points[n]);
    }
  }

  Interval range(int channel, const Box& box) const override {
    if (channel == inside_channel_number) return meet(box, mesh_->bounds()) ? Interval(0, 1) : Interval(0);
    if (!box.is_bounded()) return Interval::everything();
    Box queried = box;
    if (outside_.kind == OutsideRule::Kind::none) return Interval::everything();
    if (outside_.kind == OutsideRule::Kind::nearest) {
      // All points of the box are within that distance of the mesh.
      const double reach = farthest(box);
      if (!(reach <= outside_.within_mm) || std::isinf(reach)) return Interval::everything();
      queried = box.expanded(reach * (1 + rounding));
    }
    Interval found = bounds_of(channel).over(queried);
    if (outside_.kind == OutsideRule::Kind::value) found = hull(found, Interval(outside_.value));
    if (!(std::isfinite(found.lo) && std::isfinite(found.hi))) return Interval::everything();
    const double room = rounding * std::max(std::abs(found.lo), std::abs(found.hi));
    return {found.lo - room, found.hi + room};
  }

 private:
  static constexpr int inside_channel_number = 0;
  static constexpr double rounding = 1e-12;

  std::optional<ElementPlace> outside(Vec3 p, uint32_t& triangle_beside) const {
    if (outside_.kind != OutsideRule::Kind::nearest || !is_finite(p)) return std::nullopt;
    const ElementPlace place = mesh_->nearest(p, &triangle_beside);
    return std::isfinite(place.distance_mm) && place.distance_mm <= outside_.within_mm ? std::optional(place)
                                                                                       : std::nullopt;
  }

  const ResultChannel& of(int channel) const { return channels_[static_cast<size_t>(channel - 1)]; }

  double value(int channel, size_t element, const ResultMesh::Weights& weights) const {
    return mesh_->value(mesh_->results().fields[of(channel).field], of(channel).component, element, weights);
  }

  double value_outside(Vec3 p) const {
    const bool is_known = outside_.kind == OutsideRule::Kind::value && is_finite(p);
    return is_known ? outside_.value : std::numeric_limits<double>::quiet_NaN();
  }

  // Returns an upper bound on the distance of the box's points from the mesh.
  double farthest(const Box& box) const {
    const double half = 0.5 * length(box.size());
    const double middle = mesh_->place(box.center()) ? 0 : mesh_->nearest(box.center()).distance_mm;
    return (half + middle) * (1 + rounding);
  }

  const ChannelBounds& bounds_of(int channel) const {
    const std::scoped_lock lock(mutex_);
    auto& known = channel_bounds_[channel];
    if (!known) {
      const ResultChannel& which = of(channel);
      known = std::make_unique<ChannelBounds>(*mesh_, mesh_->results().fields[which.field], which.component);
    }
    return *known;
  }

  std::shared_ptr<const ResultMesh> mesh_;
  OutsideRule outside_;
  std::vector<ResultChannel> channels_;
  mutable std::mutex mutex_;
  mutable std::map<int, std::unique_ptr<ChannelBounds>> channel_bounds_;
};

}  // namespace

std::string result_channel_name(size_t field, size_t component) {
  return std::to_string(field) + "." + std::to_string(component);
}

program::SourceField make_result_source(std::string name, std::shared_ptr<const ResultMesh> mesh,
                                        const OutsideRule& outside, const Hash& content) {
  return std::make_shared<ResultSource>(std::move(name), std::move(mesh), outside, content);
}

bool is_mesh_result(const program::FieldSource& source) {
  return dynamic_cast<const ResultSource*>(&source) != nullptr;
}

}  // namespace ombre::importing
