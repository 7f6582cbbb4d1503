// Triangle meshes as field sources.
#include "import/surfaces/mesh_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "import/fields/channels.h"
#include "import/surfaces/closest_point.h"
#include "import/surfaces/generalized_rows.h"
#include "import/surfaces/point_winding.h"
#include "import/surfaces/winding_cells.h"

namespace ombre::importing {
namespace {

// Rounding error of a distance, relative to the numbers that it is computed from.
constexpr double mesh_rounding = 1e-12;

// A value that the first caller builds while others wait.
template <class T>
class Lazy {
 public:
  template <class Build>
  const T& get(const Build& build) const {
    std::call_once(once_, [&] { build(value_); });
    return *value_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::optional<T> value_;
};

class MeshSource final : public program::NamedSource {
 public:
  MeshSource(std::string name, formats::Mesh mesh, Hash content, MeshOptions options)
      : NamedSource(std::move(name), hash_bytes(content.hex() + std::to_string(static_cast<int>(options.rule)))),
        rule_(options.rule) {
    auto surface = std::make_shared<Surface>();
    surface->vertices = std::move(mesh.vertices);
    surface->triangles = std::move(mesh.triangles);
    surface_ = std::move(surface);
    bounds_ = importing::bounds(*surface_);
  }

  Box bounds() const override { return bounds_; }

  int channel(std::string_view channel_name) const override {
    const int channel = channel_of(channel_name);
    return channel == distance_channel && !has_mesh_distance() ? -1 : channel;
  }

  double sample(int channel, Vec3 p) const override {
    if (channel == inside_channel) return contains(p) ? 1 : 0;
    const double distance = closest().nearest(p).distance_mm;
    return contains(p) ? -distance : distance;
  }

  // The triangle nearest to the previous point is used as a guess, or at the beginning of a row the one of the previous
  // row's first point. The sign is reused if the step is shorter than the distance to the surface.
  void sample_all(int channel, std::span<const Vec3> points, std::span<double> values) const override {
    if (channel != distance_channel) return FieldSource::sample_all(channel, points, values);
    // share of that distance within which the sign cannot change
    const double sure = has_reliable_sign() ? 1 - mesh_rounding : 0;
    struct Known {
      Vec3 at;
      ClosestPoint::Nearest nearest;
      bool is_inside = false;
    } last, first_of_row;
    for (size_t n = 0; n < points.size(); ++n) {
      const bool begins = n == 0 || !(length(points[n] - last.at) <= length(points[n] - first_of_row.at));
      const Known& known = begins ? first_of_row : last;
      const double way = length(points[n] - known.at), before = known.nearest.distance_mm;
      Known now{points[n], closest().nearest(points[n], known.nearest.triangle), known.is_inside};
      const double distance = now.nearest.distance_mm;
      const bool is_known = std::isfinite(before) && way < sure * std::max(before, distance);
      if (!is_known) now.is_inside = contains(points[n]);
      values[n] = now.is_inside ? -distance : distance;
      last = now;
      if (begins) first_of_row = now;
    }
  }

  // The sign of the distance also answers the channel "inside".
  void sample_channels(std::span<const int> channels, std::span<const Vec3> points,
                       std::span<double* const> values) const override {
    const auto distance = std::ranges::find(channels, distance_channel);
    if (distance == channels.end()) return FieldSource::sample_channels(channels, points, values);
    const double* const distances = values[static_cast<size_t>(distance - channels.begin())];
    sample_all(distance_channel, points, {values[static_cast<size_t>(distance - channels.begin())], points.size()});
    for (size_t c = 0; c < channels.size(); ++c) {
      if (values[c] == distances) continue;
      for (size_t n = 0; n < points.size(); ++n)
        values[c][n] = channels[c] == distance_channel ? distances[n] : std::signbit(distances[n]) ? 1 : 0;
    }
  }

  double ops_of_sample(int channel) const override { return channel == distance_channel ? 500 : 1; }

  Interval range(int channel, const Box& box) const override {
    if (channel == distance_channel) return distance_range(box);
    return intersect(box, bounds_).is_empty() ? Interval(0) : Interval(0, 1);
  }

  std::unique_ptr<program::RowSampler> rows(int channel, const Affine& source_from_index) const override {
    if (channel != inside_channel) return nullptr;
    const double volume = determinant(source_from_index);
    if (volume == 0 || !std::isfinite(volume)) return nullptr;
    if (rule_ == InsideRule::generalized) return std::make_unique<GeneralizedRows>(generalized(), source_from_index);
    return std::make_unique<RowWinding>(surface_, source_from_index, rule_);
  }

  std::unique_ptr<program::RowSampler> rays(int channel, const program::RayLattice& rays,
                                            const Affine& source_from_view) const override {
    if (channel != inside_channel || rule_ == InsideRule::generalized) return nullptr;
    const double volume = determinant(source_from_view);
    if (volume == 0 || !std::isfinite(volume)) return nullptr;
    return std::make_unique<RowWinding>(*surface_, rays, source_from_view, rule_);
  }

 private:
  bool contains(Vec3 p) const {
    if (!bounds_.contains(p)) return false;
    if (rule_ == InsideRule::generalized) return generalized()->contains(p);
    if (has_reliable_sign())
      if (const auto winding = cells().at(p)) return is_inside(*winding, rule_);
    return is_inside(windings().at(p), rule_);
  }

  // Distances in the box differ from that at its centre by at most half its diagonal.
  Interval distance_range(const Box& box) const {
    if (!box.is_bounded() || bounds_.is_empty()) return Interval::everything();
    const Vec3 center = box.center();
    const double value = sample(distance_channel, center);
    const double reach = 0.5 * length(box.size());
    const double room = reach + mesh_rounding * (reach + std::abs(value) + length(center));
    if (has_reliable_sign()) return outward(value - room, value + room);
    const double farthest = std::abs(value) + room;
    return outward(-farthest, farthest);
  }

  // Returns false if the sign may change where the distance is not zero, as in the gaps of an open mesh.
  bool has_reliable_sign() const {
    if (rule_ == InsideRule::generalized) return false;
    return is_closed_.get([&](std::optional<bool>& value) {
      formats::Mesh mesh;
      mesh.vertices = surface_->vertices;
      mesh.triangles = surface_->triangles;
      value = inspect(mesh).is_closed();
    });
  }

  const PointWinding& windings() const {
    return windings_.get([&](std::optional<PointWinding>& value) { value.emplace(surface_); });
  }
  // Returns the cells of a closed mesh.
  const WindingCells& cells() const {
    return cells_.get([&](std::optional<WindingCells>& value) { value.emplace(windings()); });
  }
  const std::shared_ptr<const GeneralizedWinding>& generalized() const {
    return generalized_.get([&](std::optional<std::shared_ptr<const GeneralizedWinding>>& value) {
      value = std::make_shared<GeneralizedWinding>(*surface_);
    });
  }
  const ClosestPoint& closest() const {
    return closest_.get([&](std::optional<ClosestPoint>& value) { value.emplace(surface_); });
  }

  InsideRule rule_;
  SurfacePtr surface_;
  Box bounds_;
  Lazy<PointWinding> windings_;
  Lazy<WindingCells> cells_;
  Lazy<std::shared_ptr<const GeneralizedWinding>> generalized_;
  Lazy<ClosestPoint> closest_;
  Lazy<bool> is_closed_;
};

}  // namespace

program::SourceField make_mesh_source(std::string name, formats::Mesh mesh, Hash content, MeshOptions options) {
  return std::make_shared<MeshSource>(std::move(name), std::move(mesh), content, options);
}

}  // namespace ombre::importing
