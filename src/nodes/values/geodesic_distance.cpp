// Distances along the surfaces of meshes.
#include <cmath>

#include "base/system/assert.h"
#include "design/ports/file_names.h"
#include "design/ports/places.h"
#include "design/source_loader.h"
#include "design/spec.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Field;

constexpr size_t most_begins = 10000;

struct GeodesicDistance {
  FilePath path;
  Points points;
  double step = 0;
  program::SourceField source;  // read when the node is made

  static Spec<GeodesicDistance> spec() {
    return {
        "geodesic_distance",
        "The length of the shortest way along the surface of a mesh file, from the nearest of some points to the "
        "point of the surface that is nearest here.",
        {{"path", &GeodesicDistance::path,
          "A mesh file, whose surface may be open; relative to the script, then to the working directory", required()},
         {"points", &GeodesicDistance::points, "Points where ways begin, at the nearest point of the surface",
          required(unit::points)},
         {"step", &GeodesicDistance::step,
          "Ways also begin on the straight lines from point to point, at most this far apart; 0: at the points alone",
          unit::not_negative_mm}},
        no_inputs,
        "sphere(20, mix(\"red\", \"blue\", geodesic_distance(\"models/painted_ball.ply\", [[0, 0, 20]]) / 63));",
        {{"distance", &GeodesicDistance::distance, "mm; exact on the triangles of the mesh", Interval(0, Box::inf)}}};
  }

  bool complete(const Reader& reader) {
    if (points.at.empty())
      return reader.refuse("geodesic_distance needs a point where ways begin",
                           "write for example " + spelled::parameter("points", "[(0, 0, 20)]"));
    if (!reader.loader) return reader.refuse("meshes cannot be read here");
    GeodesicRequest request{path, begins()};
    if (request.from.size() > most_begins)
      return reader.refuse(
          "ways begin at " + std::to_string(request.from.size()) + " points, more than " + std::to_string(most_begins),
          "choose a greater step");
    source = reader.loader->source(request, reader);
    path = request.file;
    return source != nullptr;
  }

  Field distance(const Ask& ask) const {
    const int number = source->channel("distance");
    ASSERT(number >= 0);
    return ask.p.builder().source(source, number, ask.p.x, ask.p.y, ask.p.z);
  }

 private:
  // Returns the points, with more between them; one more than are allowed ends the list.
  std::vector<Vec3> begins() const {
    std::vector<Vec3> all{points.at.front()};
    for (size_t n = 1; n < points.at.size(); ++n) {
      const Vec3 a = points.at[n - 1], way = points.at[n] - a;
      const double parts = step > 0 ? std::max(1.0, std::ceil(length(way) / step)) : 1;
      for (double part = 1; part <= parts; ++part) {
        if (all.size() > most_begins) return all;
        all.push_back(a + (part / parts) * way);
      }
    }
    return all;
  }
};

}  // namespace

void add_geodesic_distance(Registry& registry) { registry.add<GeodesicDistance>("values"); }

}  // namespace ombre::nodes
