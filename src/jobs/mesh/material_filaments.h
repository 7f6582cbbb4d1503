// The filaments, and mixtures of them, that a materials file describes.
#pragma once

#include "formats/slicers/flavour.h"
#include "jobs/common/events.h"
#include "jobs/mesh/meshed_design.h"
#include "load/loaded.h"

namespace ombre::formats {
struct MeshDocument;
}

namespace ombre::jobs {

// Returns whether a material of the table has a member "extruder" or "mix_layers". "extruder" is the number of its
// filament, from 1. "mix_layers" of a material that is mixed are the layers of a cycle that each of its filaments
// prints: {"cyan": 2, "white": 1}.
bool describes_filaments(const design::MaterialTable& materials);

// Adds diagnostics, with their places in the materials file, for members that a project of the program cannot have.
void check_material_filaments(const design::MaterialTable& materials, formats::SlicerFlavour flavour,
                              Diagnostics& diagnostics);

// Gives the document the filaments and mixtures of the table, which was checked, and its bodies, which are those of
// materials, their extruders. Filaments with an extruder of their own keep it; the others that are used take free
// numbers, in the order of the table.
void add_material_filaments(const design::MaterialTable& materials, const compile::MeshedDesign& made,
                            const Events& events, formats::MeshDocument& document);

// Throws WrongArgument if the program has no filaments of these numbers, or cannot mix them. `are_of_materials` says
// that the table described them.
void check_filament_numbers(const formats::MeshDocument& document, formats::SlicerFlavour flavour,
                            bool are_of_materials);

}  // namespace ombre::jobs
