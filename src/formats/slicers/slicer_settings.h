// Slicers' settings for bodies: their names in PrusaSlicer, and in Bambu Studio and OrcaSlicer.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/mesh/mesh_document.h"
#include "formats/slicers/flavour.h"

namespace ombre::formats {

// A setting whose names differ, or which a standard attribute of designs sets.
struct SlicerKey {
  std::string_view prusa, bambu;  // empty if the program has no such setting for bodies or objects
  std::string_view attribute;     // empty if no attribute sets it
  bool is_whole = false;          // takes whole numbers
  std::string_view unit;          // what slicers want behind the number
};

std::span<const SlicerKey> slicer_keys();
// Returns the setting that an attribute sets, or null.
const SlicerKey* slicer_key_of(std::string_view attribute);

// Returns the name of a setting in the program, given one of PrusaSlicer or its own; empty if it has no such setting.
std::string key_in(SlicerFlavour flavour, std::string_view key);

// Returns settings with the program's keys: the body's own, and the extruder of its material, from 1, unless the body
// sets one. Settings that the program lacks are left out.
Settings slicer_settings(const MeshBody& body, SlicerFlavour flavour);
Settings in_words_of(SlicerFlavour flavour, const Settings& settings);

// The number of the extruder of a body, from 1.
uint32_t body_extruder(const MeshBody& body);
void set_extruder(MeshBody& body, size_t extruder);

}  // namespace ombre::formats
