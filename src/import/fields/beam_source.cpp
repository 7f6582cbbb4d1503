#include "import/fields/beam_source.h"

#include <algorithm>
#include <cmath>

#include "import/fields/beam_rows.h"
#include "import/fields/channels.h"

namespace ombre::importing {
namespace {

// Rounding error of a distance, relative to the numbers that it is computed from.
constexpr double beam_rounding = 1e-12;

BeamShapes shapes_of(const formats::BeamLattice& lattice) {
  auto shapes = std::make_shared<std::vector<BeamShape>>();
  shapes->reserve(lattice.beams.size() + lattice.balls.size());
  for (const formats::Beam& beam : lattice.beams)
    shapes->emplace_back(lattice.vertices[beam.ends[0]], lattice.vertices[beam.ends[1]], beam.radii, beam.caps);
  for (const formats::Ball& ball : lattice.balls)
    shapes->push_back(BeamShape::ball(lattice.vertices[ball.centre], ball.radius));
  return shapes;
}

Box box_around(const BeamShape& shape) {
  const Box ends = hull(Box{shape.end(0), shape.end(0)}, Box{shape.end(1), shape.end(1)});
  return ends.expanded(shape.greatest_radius());
}

BoxTree tree_of(const std::vector<BeamShape>& shapes) {
  std::vector<Box> boxes;
  boxes.reserve(shapes.size());
  for (const BeamShape& shape : shapes) boxes.push_back(box_around(shape));
  return BoxTree(boxes);
}

class BeamSource final : public program::NamedSource {
 public:
  BeamSource(std::string name, const formats::PlacedLattice& placed, Hash content)
      : NamedSource(std::move(name), content),
        lattice_from_mm_(inverse(placed.mm_from_lattice)),
        shrinks_(stretch(placed.mm_from_lattice).least),
        shapes_(shapes_of(*placed.lattice)),
        tree_(tree_of(*shapes_)) {
    const Affine& map = placed.mm_from_lattice;
    for (const BeamShape& shape : *shapes_) {
      const double radius = shape.greatest_radius();
      greatest_radius_ = std::max(greatest_radius_, radius);
      const Vec3 reach{radius * length(map.rows[0]), radius * length(map.rows[1]), radius * length(map.rows[2])};
      for (const int i : {0, 1}) {
        const Vec3 end = map(shape.end(i));
        bounds_ = hull(bounds_, Box{end - reach, end + reach});
      }
    }
    bounds_ = bounds_.expanded(beam_rounding * (length(bounds_.size()) + length(bounds_.center())));
  }

  Box bounds() const override { return bounds_; }
  int channel(std::string_view channel_name) const override { return channel_of(channel_name); }

  double sample(int channel, Vec3 p) const override {
    const Vec3 at = lattice_from_mm_(p);
    if (channel == inside_channel) return nearest(at, 0, 0) <= 0 ? 1 : 0;
    return shrinks_ * nearest(at, Box::inf, -Box::inf);
  }

  // Distances in the box differ from that at its centre by at most half its diagonal.
  Interval range(int channel, const Box& box) const override {
    if (channel == inside_channel && intersect(box, bounds_).is_empty()) return {0};
    if (!box.is_bounded()) return channel == inside_channel ? Interval(0, 1) : Interval::everything();
    const double value = sample(distance_channel, box.center()), reach = 0.5 * length(box.size());
    const double room = reach + beam_rounding * (reach + std::abs(value) + length(box.center()));
    if (channel == inside_channel) return value > room ? Interval(0) : value < -room ? Interval(1) : Interval(0, 1);
    // Inside, the reported magnitude may be less than the depth.
    const double least = value > room ? value - room : -shrinks_ * greatest_radius_;
    return outward(least, value < -room ? 0 : value + room);
  }

  std::unique_ptr<program::RowSampler> rows(int channel, const Affine& source_from_index) const override {
    if (channel != inside_channel || !is_regular(source_from_index)) return nullptr;
    return std::make_unique<BeamRows>(shapes_, lattice_from_mm_ * source_from_index);
  }

  std::unique_ptr<program::RowSampler> rays(int channel, const program::RayLattice& rays,
                                            const Affine& source_from_view) const override {
    if (channel != inside_channel || !is_regular(source_from_view)) return nullptr;
    return std::make_unique<BeamRows>(shapes_, rays, lattice_from_mm_ * source_from_view);
  }

 private:
  static bool is_regular(const Affine& map) {
    const double volume = determinant(map);
    return volume != 0 && std::isfinite(volume);
  }

  double nearest(Vec3 p, double reach, double enough) const {
    return tree_.nearest(p, reach, enough, [&](uint32_t n) { return (*shapes_)[n].distance(p); });
  }

  Affine lattice_from_mm_;
  double shrinks_;  // least factor by which the placement scales a length
  BeamShapes shapes_;
  BoxTree tree_;
  double greatest_radius_ = 0;
  Box bounds_;
};

}  // namespace

program::SourceField make_beam_source(std::string name, const formats::PlacedLattice& placed, Hash content) {
  return std::make_shared<BeamSource>(std::move(name), placed, content);
}

}  // namespace ombre::importing
