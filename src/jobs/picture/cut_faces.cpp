#include "jobs/picture/cut_faces.h"

#include <algorithm>
#include <cmath>

namespace ombre::compile {
namespace {

constexpr double room_in_pixels = 0.05;  // several times the error of where a ray meets a surface

}  // namespace

std::vector<CutFace> cut_faces(const SceneOptions& options) {
  std::vector<CutFace> faces;
  for (const Cut& cut : options.cuts)
    for (const CutPlane& plane : cut) faces.push_back({plane.axis, plane.mm, -plane.sign});
  if (!options.box) return faces;
  for (int axis = 0; axis < 3; ++axis) {
    faces.push_back({axis, options.box->lo[axis], 1});
    faces.push_back({axis, options.box->hi[axis], -1});
  }
  return faces;
}

void colour_faces(render::RayBand& band, int64_t begin, int64_t end, const render::Film& film,
                  const render::Camera& camera, const std::vector<CutFace>& faces, const FaceColours& colours) {
  const Affine design_from_view = camera.design_from_view();
  const double pixel_mm = film.pixel_mm * static_cast<double>(film.samples);
  std::vector<render::RayHit*> hits;
  std::vector<FacePlace> places;
  for (int64_t row = begin; row < end; ++row)
    for (int64_t column = 0; band.has(column, row); ++column) {
      render::RayHit& hit = band.at(column, row);
      if (hit.surface == render::RayHit::none) continue;
      const double depth = hit.surface;
      const Vec3 at = design_from_view(camera.unprojected({depth, film.right_of(column), film.down_of(row)}));
      const double room = room_in_pixels * pixel_mm * camera.stretch_at(depth);
      const auto face =
          std::ranges::find_if(faces, [&](const CutFace& one) { return std::abs(at[one.axis] - one.mm) <= room; });
      if (face == faces.end()) continue;
      hits.push_back(&hit);
      places.push_back({at, *face});
    }
  const auto found = colours(places);
  for (size_t n = 0; n < hits.size(); ++n) {
    if (found[n])
      *hits[n] = {hits[n]->surface, hits[n]->surface, render::linear(*found[n]), {}, 1};
    else
      *hits[n] = render::RayHit::nothing();
  }
}

}  // namespace ombre::compile
