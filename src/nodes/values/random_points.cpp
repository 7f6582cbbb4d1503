// Random points in solids.
#include <optional>

#include "base/text/text.h"
#include "design/spec.h"
#include "nodes/common/child_distance.h"
#include "nodes/common/made_fields.h"
#include "nodes/common/poisson_discs.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct RandomPoints {
  SolidName solid;
  std::optional<Number> distance, density;
  int seed = 0, relax = 0;
  double clearance = 0;
  Points points;  // made with the node

  static Spec<RandomPoints> spec() {
    return {"scattered_points",
            "Random points in a solid that keep a distance from each other and leave no gaps (Poisson discs), for "
            "example as the centres of Voronoi cells. The same on every machine.",
            {{"solid", &RandomPoints::solid, "The solid that holds the points", required()},
             {"distance", &RandomPoints::distance,
              "Least distance between points, mm; where it varies, that of the point where it is greater",
              unit::positive_mm},
             {"density", &RandomPoints::density,
              "Number of points per mm^3, in place of their distance; near the border of the solid it is somewhat "
              "higher",
              positive("1/mm^3")},
             {"seed", &RandomPoints::seed, "Whole number that selects the points", from_to(0, 1e9)},
             {"relax", &RandomPoints::relax,
              "Steps in which points move towards the centres of their Voronoi cells, so that these become more alike",
              from_to(0, 1000)},
             {"clearance", &RandomPoints::clearance, "Least distance of points from the border of the solid",
              unit::not_negative_mm}},
            no_inputs,
            "lattice(edges=delaunay_edges(scattered_points(sphere(8), distance=4).points), radius=0.4, "
            "material=\"red\");",
            {{"points", &RandomPoints::points, "The points, in mm"}, {"count", &RandomPoints::count, "Their number"}}};
  }

  int count() const { return static_cast<int>(points.at.size()); }

  bool complete(const Reader& reader) {
    if (distance.has_value() == density.has_value())
      return reader.refuse(distance ? "scattered_points has both the distance and the density of its points"
                                    : "scattered_points has neither the distance nor the density of its points",
                           "write for example " + spelled::parameter("distance", "2"));
    const Box box = box_of(solid, design_space());
    if (box.is_empty()) return true;
    if (!has_ends(box))
      return reader.refuse("the solid of scattered_points has no end",
                           "cut it, for example with an intersection with a cube");
    if (clearance > 0) warn_of_implicit_distance(reader, *solid.node, "clearance");
    return scatter(reader, box);
  }

 private:
  bool scatter(const Reader& reader, const Box& box) {
    std::vector<NodePtr> roots{NodePtr(NodePtr(), solid.node)};
    add_nodes_of(distance ? *distance : *density, roots);
    const MadeFields fields(reader, roots, box, [&](Lowering& lowering, const program::Point& p) {
      return std::vector{outside_of(lowering, solid, p), apart(p)};
    });
    const PointHost host{box,
                         [&](Vec3 p, std::vector<double>& memory) {
                           const std::vector<double> found = fields.at(p, memory);
                           return std::array{found[0], found[1]};
                         },
                         [&](const Box& part) {
                           const std::vector<Interval> found = fields.range(part);
                           return std::array{found[0], found[1]};
                         }};
    ScatteredPoints found = scatter_points(host, {static_cast<uint64_t>(seed), relax, clearance});
    if (!found.problem.empty()) return reader.refuse("scattered_points: " + found.problem, found.hint);
    points.at = std::move(found.points);
    if (points.at.empty())
      reader.diagnostics.warning(reader.where, "scattered_points found no place for a point in the solid",
                                 "take a smaller distance, or a smaller clearance from its border");
    return true;
  }

  // Returns the distance between points, which follows from their density.
  Field apart(const program::Point& p) const {
    if (distance) return (*distance)(p);
    return power(p.constant(points_per_cubed_distance) / (*density)(p), p.constant(1.0 / 3));
  }
};

}  // namespace

void add_random_points(Registry& registry) { registry.add<RandomPoints>("values"); }

}  // namespace ombre::nodes
