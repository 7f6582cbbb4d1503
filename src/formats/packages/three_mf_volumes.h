// Reads slicers' own files about the objects in a 3MF package. Only for builds with pugixml.
#pragma once

#include "formats/containers/xml_file.h"
#include "formats/packages/assembly.h"
#include "formats/packages/extruder_colours.h"

namespace ombre::formats {

// Separates the volumes that PrusaSlicer stores in one mesh: they get their names, and those that are not solids
// (modifiers, regions for supports) are removed. Volumes without a colour get that of their extruder. `part` is the
// package's main model file.
void apply_prusa_volumes(const XmlFile& settings, const std::string& part, const ExtruderColours& extruders,
                         Assembly& assembly);

// Names, removes and colours the components of an object in the same way, for files of Bambu Studio and OrcaSlicer.
void apply_bambu_parts(const XmlFile& settings, const std::string& part, const ExtruderColours& extruders,
                       Assembly& assembly);

}  // namespace ombre::formats
