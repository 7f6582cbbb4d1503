// Loads paths as field sources for designs.
#include "import/fields/path_source.h"

#include "sources/loading.h"

namespace ombre::design {

std::shared_ptr<const program::FieldSource> PathRequest::load(sources::Loading& loading) {
  using Made = sources::Loading::Made<Result>;
  constexpr size_t bytes_per_point = 150;  // for the segments and their tree
  sources::Key key(are_separate ? "points" : "path");
  key.add({reinterpret_cast<const char*>(points.data()), points.size() * sizeof points[0]});
  return loading.cached<Result>(key.hash(), "path", [&](const Reader&) {
    return Made{are_separate ? importing::make_points_source(points) : importing::make_path_source(points),
                bytes_per_point * points.size()};
  });
}

}  // namespace ombre::design
