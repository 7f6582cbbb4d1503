// Slicers' settings for bodies: their names in PrusaSlicer, and in Bambu Studio and OrcaSlicer.
#pragma once

#include <span>
#include <string_view>

#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

using Settings = std::vector<std::pair<std::string, std::string>>;

// A setting whose names differ, or which a standard attribute of designs sets.
struct SlicerKey {
  std::string_view prusa, bambu;  // equal where `bambu` is empty
  std::string_view attribute;     // empty if no attribute sets it
  bool is_whole = false;          // takes whole numbers
  std::string_view unit;          // what PrusaSlicer wants behind the number
};

std::span<const SlicerKey> slicer_keys();
// Returns the setting that an attribute sets, or null.
const SlicerKey* slicer_key_of(std::string_view attribute);
// Returns the name of PrusaSlicer's setting in Bambu Studio and OrcaSlicer.
std::string bambu_key(const std::string& prusa);

// Returns settings with PrusaSlicer's keys: the body's own, and the extruder of its material, from 1, unless the body
// sets one.
Settings slicer_settings(const MeshBody& body);

}  // namespace ombre::formats
