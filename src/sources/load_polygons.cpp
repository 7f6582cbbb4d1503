// Loads polygons as field sources for designs.
#include "import/fields/polygon_source.h"
#include "import/fields/polygon_walls.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

size_t count_points(const Polygons& polygons) {
  size_t count = 0;
  for (const auto* rings : {&polygons.solid, &polygons.holes})
    for (const Ring& ring : *rings) count += ring.size();
  return count;
}

Hash key_of_polygons(const Polygons& polygons, bool turns) {
  sources::Key key(turns ? "polygons that turn" : "polygons");
  for (const auto* rings : {&polygons.solid, &polygons.holes}) {
    key.add(static_cast<double>(rings->size()));
    for (const Ring& ring : *rings) key.add({reinterpret_cast<const char*>(ring.data()), ring.size() * sizeof ring[0]});
  }
  return key.hash();
}

void warn_of_crossings(const Polygons& polygons, const Reader& reader) {
  for (const auto* rings : {&polygons.solid, &polygons.holes})
    for (const Ring& ring : *rings) {
      const auto edges = importing::find_self_crossing(ring);
      if (!edges) continue;
      reader.diagnostics.warning(reader.where,
                                 "the polygon crosses itself: its edges behind points " +
                                     std::to_string((*edges)[0] + 1) + " and " + std::to_string((*edges)[1] + 1) +
                                     " meet",
                                 "all that it goes round counts as inside");
    }
}

}  // namespace

std::shared_ptr<const program::FieldSource> PolygonsRequest::load(sources::Loading& loading) {
  using Made = sources::Loading::Made<Result>;
  constexpr size_t bytes_per_point = 200;  // for the edges, their tree and their rows
  return loading.cached<Result>(key_of_polygons(polygons, turns), "polygon", [&](const Reader& reader) {
    warn_of_crossings(polygons, reader);
    const size_t bytes = bytes_per_point * count_points(polygons);
    return Made{importing::make_polygon_source("polygon", std::move(polygons), {turns}), bytes};
  });
}

}  // namespace ombre::design
