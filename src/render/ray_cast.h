// Casts a ray through each pixel of a picture and notes what it meets.
#pragma once

#include <functional>

#include "render/film.h"
#include "render/scene.h"

namespace ombre::render {

class KnownEnds;

// Of rows [begin, end), which may lie beyond the film. The same whatever the band, but for sums over translucent
// material, and the number of threads.
// Surfaces are found to some thousandths of a pixel of the picture; what is thinner than a quarter of one along the
// ray may be missed. `is_stopped` is called now and then; if it says so, the rest is left unset.
// Of a scene without translucent material whose rays' ends are known, only the colours are evaluated; others are kept
// there. It changes no hit.
RayBand cast_rays(const Scene& scene, const Film& film, int64_t begin, int64_t end, int threads,
                  const std::function<bool()>& is_stopped, KnownEnds* known = nullptr);

}  // namespace ombre::render
