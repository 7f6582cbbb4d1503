// Loads paths as field sources for designs.
#include "import/fields/path_source.h"

#include "sources/loading.h"

namespace ombre::design {
namespace {

program::SourceField source_of(const PathRequest& request) {
  const std::vector<Vec3>& points = request.points;
  switch (request.kind) {
    case PathKind::path:
      return importing::make_path_source(points);
    case PathKind::separate:
      return importing::make_points_source(points);
    case PathKind::pairs:
      return request.fillet > 0 ? importing::make_filleted_source(points, request.fillet)
                                : importing::make_segments_source(points);
    case PathKind::triples:
      return importing::make_triangles_source(points);
    case PathKind::cells:
      break;
  }
  return importing::make_point_cells_source(points);
}

}  // namespace

std::shared_ptr<const program::FieldSource> PathRequest::load(sources::Loading& loading) {
  using Made = sources::Loading::Made<Result>;
  constexpr size_t bytes_per_point = 150;  // for the segments and their tree
  sources::Key key("path");
  key.add(static_cast<double>(kind));
  key.add(fillet);
  key.add({reinterpret_cast<const char*>(points.data()), points.size() * sizeof points[0]});
  return loading.cached<Result>(key.hash(), "path", [&](const Reader&) {
    return Made{source_of(*this), bytes_per_point * points.size()};
  });
}

}  // namespace ombre::design
