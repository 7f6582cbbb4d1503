// Ranges of heights in slicers' files.
#pragma once

#include <string>

#include "formats/mesh/mesh_document.h"
#include "formats/slicers/flavour.h"

namespace ombre::formats {

// Returns the ranges as PrusaSlicer, Bambu Studio and OrcaSlicer write them; empty if there are none. `object` is the
// number of the object in the model.
std::string height_ranges(const MeshDocument& document, SlicerFlavour flavour, uint64_t object);

}  // namespace ombre::formats
