// Struts and walls of the Voronoi cells of points, and of Delaunay's tetrahedra between points.
#include <cmath>
#include <numbers>
#include <optional>

#include "base/math/point_sets.h"
#include "base/math/segment_sets.h"
#include "base/system/assert.h"
#include "design/source_loader.h"
#include "design/spec.h"
#include "nodes/common/child_distance.h"
#include "nodes/common/made_fields.h"
#include "nodes/common/strut_families.h"

namespace ombre::nodes {
namespace {

using namespace design;

enum class Between : uint8_t { voronoi, delaunay };

bool load_distances(PathRequest request, program::SourceField& source, const Reader& reader) {
  if (!reader.loader) return reader.refuse("distances to points cannot be made here");
  source = reader.loader->source(request, reader);
  return source != nullptr;
}

Field distance_from(const program::SourceField& source, const program::Point& p) {
  const int channel = source->channel("distance");
  ASSERT(channel >= 0);
  return p.builder().source(source, channel, p.x, p.y, p.z);
}

bool refuse_points(const Reader& reader, const std::string& problem) {
  return reader.refuse("points of " + std::string(reader.node) + ": " + problem);
}

// Returns false and adds an error if there is no region although the lattice is closed at its surface. Warns if the
// region has no distances.
bool check_region(const Reader& reader, const SolidName& region, bool is_closed) {
  if (region.node) warn_of_implicit_distance(reader, *region.node, std::string(reader.node));
  return region.node || !is_closed ||
         reader.refuse(std::string(reader.node) + " has no region at which it could be closed",
                       "write for example " + spelled::parameter("region", "sphere(10)"));
}

bool load_walls(Between kind, const Points& points, program::SourceField& source, const Reader& reader) {
  if (kind == Between::voronoi) {
    if (points.at.size() < 2) return refuse_points(reader, "there must be at least 2, for walls between them");
    return load_distances({points.at, PathKind::cells}, source, reader);
  }
  const auto faces = delaunay_faces(points.at);
  if (!faces.problem.empty()) return refuse_points(reader, faces.problem);
  std::vector<Vec3> corners;
  for (const auto& face : faces.list) corners.insert(corners.end(), face.begin(), face.end());
  return load_distances({std::move(corners), PathKind::triples}, source, reader);
}

struct PointLattice {
  Points points;
  SolidName region;
  bool closed = false;
  MaterialName material;
  program::SourceField walls;  // between the cells; made with the node

  bool makes_nothing() const { return points.at.empty(); }

  // Returns the parameters of T, which derives from this class. The second one is how thick it is.
  template <class T>
  static std::vector<Parameter<T>> parameters(Parameter<T> thickness, std::string_view closed_doc) {
    return {{"points", &T::points, "The points, for example of scattered_points", required(unit::points)},
            std::move(thickness),
            {"region", &T::region, "The solid that is filled, at whose surface they are cut off"},
            {"closed", &T::closed, closed_doc},
            {"material", &T::material, "Their material"}};
  }
};

template <Between kind>
struct PointStruts : PointLattice {
  Number radius = 0.5;
  std::optional<double> blend;
  program::SourceField struts;  // made with the node, and walls if closed
  size_t most_at_once = 1;      // greatest number of struts whose fillets meet
  size_t count = 0;             // of struts

  static Spec<PointStruts> spec() {
    constexpr bool is_voronoi = kind == Between::voronoi;
    auto all = parameters<PointStruts>(
        {"radius", &PointStruts::radius, "Radius of the struts", unit::positive_mm},
        "Adds struts along the lines in which walls between cells meet the surface of the region; as thick as the "
        "others where these meet it at right angles");
    all.emplace_back("blend", &PointStruts::blend,
                     "Radius of fillets along the seams of struts, whose radius is a number then; none: sharp seams",
                     unit::positive_mm);
    return {is_voronoi ? "voronoi_struts" : "delaunay_struts",
            is_voronoi ? "An open foam: struts along the edges of the Voronoi cells of points, with round joints."
                       : "Struts from point to point along the edges of Delaunay's tetrahedra, with round joints.",
            std::move(all),
            no_inputs,
            is_voronoi ? "voronoi_struts(scattered_points(sphere(8), distance=5).points, 0.5, region=sphere(8), "
                         "closed=true, material=\"red\");"
                       : "delaunay_struts(scattered_points(sphere(8), distance=5).points, 0.5, material=\"red\");",
            {{"points", &PointStruts::points, "The points"},
             {"struts", &PointStruts::edges, "Its struts as edges, of which some may lie outside of the region"}}};
  }

  bool complete(const Reader& reader) {
    if (!check_region(reader, region, closed)) return false;
    const OfPoints<Edge3> edges = edges_here();
    if (!edges.problem.empty()) return refuse_points(reader, edges.problem);
    if (edges.list.empty()) return refuse_points(reader, "there are no edges between cells here");
    count = edges.list.size();
    if (!(blend ? load_with_fillets(edges.list, reader) : load_struts(edges.list, 0, reader))) return false;
    return !closed || load_walls(kind, points, walls, reader);
  }

  std::vector<Edge> edges() const {
    std::vector<Edge> all;
    for (const auto& [start, end] : edges_here().list) all.push_back({start, end});
    return all;
  }

  // Returns the struts as cylinders, or why they are not.
  StrutsOrReason beams() const {
    if (closed) return {{}, "struts along the surface of a region are not straight"};
    if (blend) return {{}, "struts have fillets"};
    if (!radius.constant()) return {{}, radius_varies_by_place};
    NodeStruts made{.struts = {}, .region = region};
    for (const auto& [start, end] : edges_here().list)
      made.struts.push_back({start, end, *radius.constant(), *radius.constant()});
    return {std::move(made)};
  }

  Metric metric() const {
    const Metric own = Metric::bounded(blend ? std::sqrt(static_cast<double>(at_once())) : 1);
    return region.node ? weaker(own, region.node->metric()) : own;
  }
  Box reach(const Inputs&, const Box& where, double margin) const {
    const Box own = closed ? where : struts->bounds().expanded(radius.range(where).hi + reach_of_struts(margin));
    return region.node ? intersect(own, box_of(region, where, margin)) : own;
  }

  Field distance(const Inputs& in, const program::Point& p) const {
    const Field r = radius(p), inner = distance_from(struts, p) - r;
    if (!region.node) return inner;
    const Field outside = in.distance_to(region, p);
    if (!closed) return max(outside, inner);
    // The distance from the line changes by at most sqrt(2) mm for each mm.
    const Field rim = length(outside, distance_from(walls, p)) - r;
    return max(outside, blend ? with_fillet(inner, rim) : min(inner, rim / std::numbers::sqrt2));
  }

 private:
  bool load_struts(const std::vector<Edge3>& edges, double fillet, const Reader& reader) {
    std::vector<Vec3> ends;
    for (const Edge3& edge : edges) ends.insert(ends.end(), edge.begin(), edge.end());
    return load_distances({std::move(ends), PathKind::pairs, fillet}, struts, reader);
  }
  // Struts in line are one, since seams between them would have a fillet.
  bool load_with_fillets(const std::vector<Edge3>& edges, const Reader& reader) {
    constexpr double same_place = 1e-9;  // mm
    if (!radius.constant())
      return reader.refuse("the radius of struts with fillets changes from place to place",
                           "write a number, or leave out blend");
    const double fillet = *radius.constant() + *blend;
    const std::vector<Edge3> lines = joined_in_line(edges, same_place);
    most_at_once = most_within(lines, fillet);
    return load_struts(lines, fillet, reader);
  }

  // The lines at the surface count as two struts, since their distance changes by sqrt(2) mm for each mm.
  size_t at_once() const { return most_at_once + (closed ? 2 : 0); }
  // Returns how far from the surfaces of struts a point may be at which g is at most the margin. The g of n struts with
  // fillets of the radius k is at least k - (k - d) sqrt(n), where d is their least distance.
  double reach_of_struts(double margin) const {
    if (!blend || margin >= *blend) return margin;
    return *blend - (*blend - margin) / std::sqrt(static_cast<double>(at_once()));
  }
  // Joins the struts, whose g has fillets, with another solid.
  Field with_fillet(Field struts_distance, Field other) const {
    const Field of_struts = max(*blend - struts_distance, 0.0), of_other = max(*blend - other, 0.0);
    return max(min(struts_distance, other), *blend) - length(of_struts, of_other);
  }

  OfPoints<Edge3> edges_here() const {
    if constexpr (kind == Between::delaunay) return delaunay_edges(points.at);
    if (!region.node) return voronoi_edges(points.at, std::nullopt);
    const Box box = box_of(region, design_space());
    return voronoi_edges(points.at, box.expanded(radius.range(box).hi));
  }
};

template <Between kind>
struct PointWalls : PointLattice {
  Number thickness = 0.5;

  static Spec<PointWalls> spec() {
    constexpr bool is_voronoi = kind == Between::voronoi;
    return {is_voronoi ? "voronoi_walls" : "delaunay_walls",
            is_voronoi ? "A closed foam: walls between the Voronoi cells of points."
                       : "Walls along the faces of Delaunay's tetrahedra between points.",
            parameters<PointWalls>({"thickness", &PointWalls::thickness, "Thickness of the walls", unit::positive_mm},
                                   "Adds a skin of the same thickness inside the surface of the region"),
            no_inputs,
            is_voronoi ? "voronoi_walls(scattered_points(sphere(8), distance=5).points, 0.5, region=sphere(8), "
                         "material=\"red\");"
                       : "delaunay_walls(scattered_points(sphere(8), distance=5).points, 0.5, material=\"red\");",
            {{"points", &PointWalls::points, "The points"}}};
  }

  bool complete(const Reader& reader) {
    if (!check_region(reader, region, closed)) return false;
    return load_walls(kind, points, walls, reader);
  }

  Metric metric() const { return weaker(Metric::bounded(), region.node ? region.node->metric() : Metric::exact()); }
  Box reach(const Inputs&, const Box& where, double margin) const {
    const Box own = closed ? where : walls->bounds().expanded(thickness.range(where).hi / 2 + margin);
    return region.node ? intersect(own, box_of(region, where, margin)) : own;
  }

  Field distance(const Inputs& in, const program::Point& p) const {
    const Field t = thickness(p), inner = distance_from(walls, p) - t * 0.5;
    if (!region.node) return inner;
    const Field outside = in.distance_to(region, p);
    return closed ? max(outside, min(inner, -outside - t)) : max(outside, inner);
  }
};

template <Between kind>
std::optional<StrutMaker> maker_of(const Node& node) {
  const auto* made = dynamic_cast<const NodeOf<PointStruts<kind>>*>(&node);
  if (!made) return std::nullopt;
  return StrutMaker{made->data.count, [made] { return made->data.beams(); }};
}

}  // namespace

std::optional<StrutMaker> point_struts(const Node& node) {
  const auto voronoi = maker_of<Between::voronoi>(node);
  return voronoi ? voronoi : maker_of<Between::delaunay>(node);
}

void add_point_lattices(Registry& registry) {
  registry.add<PointStruts<Between::voronoi>, PointWalls<Between::voronoi>, PointStruts<Between::delaunay>,
               PointWalls<Between::delaunay>>("lattices");
}

}  // namespace ombre::nodes
