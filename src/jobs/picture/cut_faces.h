// The faces that cuts leave, in colours of their own.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "jobs/picture/design_scene.h"
#include "render/camera.h"
#include "render/film.h"
#include "render/shade.h"

namespace ombre::compile {

// A plane in which a cut leaves faces. What is left lies on the side of the sign.
struct CutFace {
  int axis = 2;
  double mm = 0;
  int inward = 1;
};
std::vector<CutFace> cut_faces(const SceneOptions& options);

// A place in the design's space where a ray meets a face.
struct FacePlace {
  Vec3 at;
  CutFace face;
};
// Returns the colours of places; nothing where there is no material.
using FaceColours = std::function<std::vector<std::optional<render::Rgba8>>(const std::vector<FacePlace>& places)>;

// Gives the rays in rows [begin, end) of the band that meet faces the colours there. Faces are opaque, and rays to
// places without a colour hit nothing.
void colour_faces(render::RayBand& band, int64_t begin, int64_t end, const render::Film& film,
                  const render::Camera& camera, const std::vector<CutFace>& faces, const FaceColours& colours);

}  // namespace ombre::compile
