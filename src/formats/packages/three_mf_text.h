// The XML files within a 3MF archive (3MF Core 1.3, Materials and Properties 1.2, Production 1.1).
#pragma once

#include <string>

#include "formats/packages/package_writers.h"

namespace ombre::formats {

inline constexpr const char* three_mf_model_path = "3D/3dmodel.model";
inline constexpr const char* prusa_settings_path = "Metadata/Slic3r_PE_model.config";
inline constexpr const char* bambu_settings_path = "Metadata/model_settings.config";

// Returns the model. Objects are numbered from 1: one for each body with triangles, then the part that contains them,
// then beams and their clipping objects. For PrusaSlicer all bodies are object 1, and there are no beams.
LazyBytes three_mf_model(const MeshDocument& document, SlicerFlavour flavour);

// The model of a project for Bambu Studio and OrcaSlicer, as they write it: its bodies are in a file of their own,
// which the main file places. Numbers of objects are as in the model above.
inline constexpr const char* bambu_objects_path = "3D/Objects/object_1.model";
LazyBytes bambu_model(const MeshDocument& document, SlicerFlavour flavour);
LazyBytes bambu_objects(const MeshDocument& document);
// Returns the number of the object that contains all bodies.
uint64_t whole_object(const MeshDocument& document, SlicerFlavour flavour);

std::string prusa_settings(const MeshDocument& document, SlicerFlavour flavour);
std::string bambu_settings(const MeshDocument& document, SlicerFlavour flavour);

}  // namespace ombre::formats
