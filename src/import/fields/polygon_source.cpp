// Polygons as field sources.
#include "import/fields/polygon_source.h"

#include <cmath>
#include <limits>

#include "import/fields/channels.h"
#include "import/fields/polygon_rows.h"
#include "import/fields/polygon_walls.h"

namespace ombre::importing {
namespace {

// Rounding error of a distance, relative to the numbers that it is computed from.
constexpr double polygon_rounding = 1e-9;

Hash hash_of(const Polygons& polygons, PolygonOptions options) {
  std::string bytes = options.turns_about_y ? "turns" : "flat";
  const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (const auto* rings : {&polygons.solid, &polygons.holes}) {
    append(static_cast<uint64_t>(rings->size()));
    for (const Ring& ring : *rings) {
      append(static_cast<uint64_t>(ring.size()));
      for (const Vec2 p : ring) {
        append(p.x);
        append(p.y);
      }
    }
  }
  return hash_bytes(bytes);
}

Box bounds_of(const Polygons& polygons) {
  Box box;
  for (const Ring& ring : polygons.solid)
    for (const Vec2 p : ring) box = hull(box, Box{{p.x, p.y, 0}, {p.x, p.y, 0}});
  if (box.is_empty()) return box;
  box.lo.z = -Box::inf;
  box.hi.z = Box::inf;
  return box;
}

std::vector<LineSegment> without_axis(std::vector<LineSegment> walls) {
  std::erase_if(walls, [](const LineSegment& wall) { return wall.from.x == 0 && wall.to.x == 0; });
  return walls;
}

class PolygonSource final : public program::NamedSource {
 public:
  PolygonSource(std::string name, Polygons polygons, PolygonOptions options)
      : NamedSource(std::move(name), hash_of(polygons, options)),
        polygons_(std::make_shared<const Polygons>(std::move(polygons))),
        bounds_(bounds_of(*polygons_)),
        crossings_(*polygons_, {1, 0}),
        walls_(polygon_walls(*polygons_, crossings_)) {
    if (options.turns_about_y) inner_walls_.emplace(without_axis(polygon_walls(*polygons_, crossings_)));
  }

  Box bounds() const override { return bounds_; }

  int channel(std::string_view channel_name) const override { return channel_of(channel_name); }

  double sample(int channel, Vec3 p) const override {
    const bool is_inside = contains(p);
    if (channel == inside_channel) return is_inside ? 1 : 0;
    const Vec3 flat{p.x, p.y, 0};
    return is_inside ? -(inner_walls_ ? *inner_walls_ : walls_).distance(flat) : walls_.distance(flat);
  }

  // Distances in the box differ from that at its centre by at most half its diagonal.
  Interval range(int channel, const Box& box) const override {
    const Interval anything = channel == inside_channel ? Interval(0, 1) : Interval::everything();
    if (box.is_empty() || !box.axis(0).is_bounded() || !box.axis(1).is_bounded()) return anything;
    if (channel == inside_channel && intersect(box, bounds_).is_empty()) return Interval(0);
    const Vec3 center{box.lo.x + 0.5 * (box.hi.x - box.lo.x), box.lo.y + 0.5 * (box.hi.y - box.lo.y), 0};
    const double value = sample(distance_channel, center);
    const double reach = 0.5 * std::sqrt(dot(Vec2{box.hi.x - box.lo.x, box.hi.y - box.lo.y},
                                             Vec2{box.hi.x - box.lo.x, box.hi.y - box.lo.y}));
    const double size =
        std::max(length(Vec3{bounds_.lo.x, bounds_.lo.y, 0}), length(Vec3{bounds_.hi.x, bounds_.hi.y, 0}));
    const double room = reach + polygon_rounding * (reach + std::abs(value) + length(center) + size);
    if (channel == distance_channel) return outward(value - room, value + room);
    return std::abs(value) > room ? Interval(value < 0 ? 1 : 0) : Interval(0, 1);
  }

  std::unique_ptr<program::RowSampler> rows(int channel, const Affine& source_from_index) const override {
    if (channel != inside_channel) return nullptr;
    for (const Vec3& row : source_from_index.rows)
      if (!is_finite(row)) return nullptr;
    return std::make_unique<PolygonRows>(polygons_, source_from_index);
  }

 private:
  bool contains(Vec3 p) const {
    if (!(bounds_.lo.x <= p.x && p.x <= bounds_.hi.x && bounds_.lo.y <= p.y && p.y <= bounds_.hi.y)) return false;
    return crossings_.winding_at({p.x, p.y}).is_inside();
  }

  std::shared_ptr<const Polygons> polygons_;
  Box bounds_;
  PolygonCrossings crossings_;
  SegmentTree walls_;
  std::optional<SegmentTree> inner_walls_;  // for solids of revolution
};

}  // namespace

program::SourceField make_polygon_source(std::string name, Polygons polygons, PolygonOptions options) {
  return std::make_shared<PolygonSource>(std::move(name), std::move(polygons), options);
}

}  // namespace ombre::importing
