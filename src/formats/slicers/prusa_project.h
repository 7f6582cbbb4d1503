// PrusaSlicer's own files within the 3MF archive of a project.
#pragma once

#include <string>

#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

inline constexpr const char* prusa_project_path = "Metadata/Slic3r_PE.config";
inline constexpr const char* prusa_ranges_path = "Metadata/Prusa_Slicer_layer_config_ranges.xml";
inline constexpr const char* prusa_mixtures_path = "Metadata/Prusa_Slicer_full_spectrum.json";

// Side of the bed that PrusaSlicer takes if a project has no other.
inline constexpr double prusa_bed_mm = 200;

// Returns the settings of the project: lines "; key = value". Only keys about filaments are given.
std::string prusa_project(const MeshDocument& document);
// Returns the mixtures of filaments as virtual extruders of PrusaSlicer 2.9.6.
std::string prusa_mixtures(const MeshDocument& document);

}  // namespace ombre::formats
