// Bodies for slicers: their settings, and the filaments of the project.
#pragma once

#include <string>
#include <vector>

#include "formats/mesh/mesh_document.h"
#include "jobs/common/events.h"
#include "jobs/mesh/mesh_choices.h"
#include "jobs/mesh/slicer_setting.h"
#include "load/loaded.h"

namespace ombre::jobs {

// Returns the document of the bodies, which it empties, without the project's filaments. Throws WrongArgument for
// settings that do not fit the bodies.
formats::MeshDocument document_of(compile::MeshedDesign& made, const std::string& title,
                                  const compile::MeshChoices& choices, const std::vector<SlicerSetting>& settings);

// Returns the setting `key` that slicers take for the middle of a band of an attribute that is one. Throws
// WrongArgument if the program takes no such number for it.
std::string setting_of_band(const std::string& attribute, const std::string& key, formats::SlicerFlavour flavour,
                            double middle);

// Warns of attributes of bands that are no settings of bodies in the slicer, or that are the same one for several
// bands.
void tell_lost_attributes(const Events& events, const compile::MeshedDesign& made, const compile::MeshChoices& choices);

// Gives a project whose bodies all have the first filament that one, with the names of the materials inside; says so if
// there are several.
void name_only_filament(const compile::Loaded& loaded, const Events& events, Diagnostics& diagnostics,
                        formats::MeshDocument& document);

// Warns of bands of a mixture that a slicer would print alike, since they have one filament and the same settings.
void tell_equal_bands(const Events& events, const compile::MeshedDesign& made, const compile::MeshChoices& choices,
                      const formats::MeshDocument& document);

}  // namespace ombre::jobs
