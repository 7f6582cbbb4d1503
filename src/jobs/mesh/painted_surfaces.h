// Paints the surfaces of bodies with filaments, triangle by triangle.
#pragma once

#include "formats/mesh/mesh_document.h"
#include "jobs/common/events.h"
#include "load/loaded.h"

namespace ombre::jobs {

// Gives each triangle the extruder of the material that it has most of (`by` is "materials"), or of the colour that an
// attribute has there, `inward_mm` below the surface. The project gets a filament for each of them, and each body the
// one that most of its surface has. Says how much of the surface lies in triangles that have several of them. Returns
// false, and adds diagnostics, when the design has no such attribute, it is no colour, or there are too many colours.
bool paint_surfaces(const compile::Loaded& loaded, const std::string& by, double inward_mm, const Events& events,
                    formats::MeshDocument& document, Diagnostics& diagnostics, int threads, const StopFlag* stop);

}  // namespace ombre::jobs
