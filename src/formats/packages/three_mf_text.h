// The XML files within a 3MF archive (3MF Core 1.3, Materials and Properties 1.2).
#pragma once

#include <string>

#include "formats/packages/package_writers.h"

namespace ombre::formats {

inline constexpr const char* three_mf_model_path = "3D/3dmodel.model";
inline constexpr const char* prusa_settings_path = "Metadata/Slic3r_PE_model.config";
inline constexpr const char* bambu_settings_path = "Metadata/model_settings.config";
inline constexpr const char* prusa_project_path = "Metadata/Slic3r_PE.config";
inline constexpr const char* bambu_project_path = "Metadata/project_settings.config";

// Returns the model. Objects are numbered from 1: one for each body with triangles, then the part that contains them,
// then beams and their clipping objects. For PrusaSlicer all bodies are object 1, and there are no beams.
LazyBytes three_mf_model(const MeshDocument& document, SlicerFlavour flavour);

std::string prusa_settings(const MeshDocument& document, SlicerFlavour flavour);
std::string bambu_settings(const MeshDocument& document);

}  // namespace ombre::formats
