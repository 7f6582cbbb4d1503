// Coordinates on surfaces as values.
#include "base/system/assert.h"
#include "base/text/text.h"
#include "nodes/values/surface_part.h"

namespace ombre::nodes {
namespace {

using namespace design;
using program::Field;
using program::Point;

struct SurfaceCoordinates : OnSurfacePart {
  std::shared_ptr<const SurfacePlaces> places;  // made with the node

  static Spec<SurfaceCoordinates> spec() {
    return {"surface_coordinates",
            "The coordinates u and v of the nearest point on a part of a mesh, which is laid out in a plane, or on a "
            "face of "
            "a CAD file, and the signed distance from it.",
            joined(path_parameter<SurfaceCoordinates>(),
                   part_parameters<SurfaceCoordinates>("Greatest distance of triangles from a CAD file's faces")),
            no_inputs,
            "sphere(8, at(mix(\"red\", \"blue\", \"sin(3*x)*sin(3*y) > 0\"), "
            "surface_coordinates(\"models/painted_ball.ply\", normal=(0, 0, 1), within=80).place));",
            {{"distance", &SurfaceCoordinates::distance,
              "Distance from the surface, positive on its outer side, mm; beyond its border to the border"},
             {"place", &SurfaceCoordinates::place, "u and v of the nearest point, from 0 on, and the distance, mm"},
             {"nearest", &SurfaceCoordinates::nearest_place, "The nearest point, mm"},
             {"normal", &SurfaceCoordinates::smooth_normal,
              "Outward direction of the surface there, of length 1, which changes evenly from corner to corner"},
             {"border", &SurfaceCoordinates::border, "Distance of the nearest point from the border of the part, mm"},
             {"length", &SurfaceCoordinates::greatest_u, "Greatest u, mm"},
             {"width", &SurfaceCoordinates::greatest_v, "Greatest v, mm"},
             {"report", &SurfaceCoordinates::report, "Extents, and stretches of lengths, as text"}}};
  }

  bool complete(const Reader& reader) {
    if (!are_sound(reader)) return false;
    SurfacePlacesRequest request{layout(), part()};
    places = reader.loader->source(request, reader);
    path = request.part.file;
    return places != nullptr;
  }

  Field distance(const Ask& ask) const { return read(ask, "distance"); }
  VectorField place(const Ask& ask) const { return {read(ask, "u"), read(ask, "v"), read(ask, "distance")}; }
  VectorField nearest_place(const Ask& ask) const { return {read(ask, "x"), read(ask, "y"), read(ask, "z")}; }
  VectorField smooth_normal(const Ask& ask) const {
    return {read(ask, "normal_x"), read(ask, "normal_y"), read(ask, "normal_z")};
  }
  Field border(const Ask& ask) const { return read(ask, "border"); }

  double greatest_u() const { return places->lengths.x; }
  double greatest_v() const { return places->lengths.y; }
  std::string report() const {
    return format_rounded(places->lengths.x) + " x " + format_rounded(places->lengths.y) +
           " mm; lengths along the surface are stretched by " + format_rounded(places->stretches.lo) + " to " +
           format_rounded(places->stretches.hi);
  }

 private:
  Field read(const Ask& ask, const char* name) const {
    const int channel = places->source->channel(name);
    ASSERT(channel >= 0);
    return ask.p.builder().source(places->source, channel, ask.p.x, ask.p.y, ask.p.z);
  }
};

}  // namespace

void add_surface_coordinates(Registry& registry) { registry.add<SurfaceCoordinates>("values"); }

}  // namespace ombre::nodes
