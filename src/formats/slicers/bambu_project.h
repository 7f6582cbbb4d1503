// The own files of Bambu Studio and OrcaSlicer within the 3MF archive of a project.
#pragma once

#include <string>

#include "formats/mesh/mesh_document.h"
#include "formats/slicers/flavour.h"

namespace ombre::formats {

inline constexpr const char* bambu_project_path = "Metadata/project_settings.config";
inline constexpr const char* bambu_ranges_path = "Metadata/layer_config_ranges.xml";

// Side of the bed that the project names.
inline constexpr double bambu_bed_mm = 256;

// Returns the version of Bambu Studio that a project needs. All programs take files for theirs if their Application
// begins with "BambuStudio-" and a version, of which the first number is at most their own.
std::string bambu_version(const MeshDocument& document, SlicerFlavour flavour);

// Returns the settings of the project as JSON: those of filaments, with their mixtures, and the bed.
std::string bambu_project(const MeshDocument& document, SlicerFlavour flavour);

}  // namespace ombre::formats
