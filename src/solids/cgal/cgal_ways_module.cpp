// Finds shortest ways along surfaces by CGAL's Surface_mesh_shortest_path.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <exception>
#include <limits>

#include "import/charts/shortest_ways.h"
#include "solids/cgal/cgal_sheet.h"

namespace ombre::importing {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = Sheet<Kernel>;
using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>;

const std::string problem = "the surface has no shortest ways";

class WaysByCgal final : public ShortestWays {
 public:
  WaysByCgal(const std::vector<Vec3>& points, const std::vector<std::array<uint32_t, 3>>& triangles,
             const std::vector<SurfacePoint>& from)
      : mesh_(sheet_of<Kernel>(points, triangles, problem)), triangles_(triangles), paths_(mesh_) {
    for (const SurfacePoint& point : from) paths_.add_source_point(face(point), shares(point));
    paths_.build_sequence_tree();
  }

  double length_to(const SurfacePoint& point) const override {
    const double length = paths_.shortest_distance_to_source_points(face(point), shares(point)).first;
    return length < 0 ? std::numeric_limits<double>::infinity() : length;
  }

 private:
  static Mesh::Face_index face(const SurfacePoint& point) { return Mesh::Face_index(point.triangle); }

  // The corners of a face begin with the source of its halfedge.
  Traits::Barycentric_coordinates shares(const SurfacePoint& point) const {
    const auto& corners = triangles_[point.triangle];
    const auto first = static_cast<uint32_t>(mesh_.source(mesh_.halfedge(face(point))));
    const auto begin = static_cast<size_t>(std::ranges::find(corners, first) - corners.begin());
    return {point.shares[begin], point.shares[(begin + 1) % 3], point.shares[(begin + 2) % 3]};
  }

  Mesh mesh_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  // Its questions change nothing once the tree is built, though they are not const.
  mutable CGAL::Surface_mesh_shortest_path<Traits> paths_;
};

}  // namespace
}  // namespace ombre::importing

void ombre_shortest_ways(const std::vector<ombre::Vec3>& points, const std::vector<std::array<uint32_t, 3>>& triangles,
                         const std::vector<ombre::importing::SurfacePoint>& from,
                         std::unique_ptr<const ombre::importing::ShortestWays>& ways) {
  using namespace ombre;
  using namespace ombre::importing;
  try {
    ways = std::make_unique<WaysByCgal>(points, triangles, from);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& failed) {
    throw Error(Code::file_content, problem + ": " + std::string(failed.what()));
  }
}
