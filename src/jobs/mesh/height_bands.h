// Attributes that vary by height alone, as ranges of heights.
#pragma once

#include <optional>
#include <vector>

#include "formats/mesh/slicer_project.h"
#include "jobs/mesh/mesh_choices.h"
#include "load/loaded.h"

namespace ombre::jobs {

// Returns the ranges of heights in which the attributes of the choice `by` stay within their bands, with the settings
// of the bands' middles, from the lowest range on. Returns nothing, and adds diagnostics, when an attribute varies
// across a layer, has no setting in the slicer, or is missing.
std::optional<std::vector<formats::HeightRange>> height_bands(const compile::Loaded& loaded,
                                                              const compile::MeshChoices& choices,
                                                              Diagnostics& diagnostics, const StopFlag* stop);

}  // namespace ombre::jobs
