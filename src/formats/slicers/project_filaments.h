// Filaments of a slicer's project.
#pragma once

#include <string>
#include <vector>

#include "formats/mesh/mesh_document.h"

namespace ombre::formats {

// Returns the document's filaments, or, if it has none, one for each extruder up to the greatest that bodies use. Each
// has the name and the colour of the material of the first body with that extruder.
std::vector<Filament> project_filaments(const MeshDocument& document);

// Returns the type that the filament's name says, such as PETG; PLA if it says none.
std::string filament_type(const Filament& filament);

// Returns the shares of the parts of a mixture, which add up to 1.
std::vector<double> shares_of(const FilamentMixture& mixture);

// Returns "#RRGGBB", since slicers' filaments have no opacity.
std::string opaque_colour(const Rgba& colour);

// Filaments may be settings of one nozzle: these are its temperature, and the G-code that sets the flow of the printer.
std::string nozzle_temperature(const Filament& filament);
std::string flow_code(const Filament& filament);
inline constexpr const char* usual_flow_code = "M221 S100";

// Returns the transform of a 3MF item that places the bodies for printing: their box is centred on the bed, a square in
// the positive quadrant, and stands on z=0.
std::string placement_on_bed(const MeshDocument& document, double bed_mm);

}  // namespace ombre::formats
