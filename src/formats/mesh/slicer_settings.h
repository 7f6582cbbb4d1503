// A slicer's settings for a body.
#pragma once

#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

using Settings = std::vector<std::pair<std::string, std::string>>;

// Returns settings with PrusaSlicer's keys: the body's own, and the extruder of its material, from 1, unless the body
// sets one.
Settings slicer_settings(const MeshBody& body);

}  // namespace ombre::formats
