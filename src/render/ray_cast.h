// Casts a ray through each pixel of a picture and records its hits.
#pragma once

#include <functional>

#include "render/film.h"
#include "render/scene.h"

namespace ombre::render {

class KnownEnds;

// Returns the hits of rows [begin, end), which may lie beyond the film. They do not depend on the number of threads,
// nor, except for sums over translucent material, on the band.
// Surfaces are found to a few thousandths of a pixel of the picture; parts thinner than a quarter of a pixel along the
// ray may be missed. `is_stopped` is called now and then; once it returns true, the rest is left unset.
// If `known` has the ends of the rays of a scene without translucent material, only colours are evaluated; otherwise
// the ends are stored there. It does not change any hit.
RayBand cast_rays(const Scene& scene, const Film& film, int64_t begin, int64_t end, int threads,
                  const std::function<bool()>& is_stopped, KnownEnds* known = nullptr);

}  // namespace ombre::render
