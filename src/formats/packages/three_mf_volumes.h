// What slicers' own files in a 3MF package say of its objects. Only for files that are built with pugixml.
#pragma once

#include "formats/containers/xml_file.h"
#include "formats/packages/assembly.h"
#include "formats/packages/extruder_colours.h"

namespace ombre::formats {

// PrusaSlicer keeps several volumes in one mesh: they get their names, and those that are no solid (modifiers, places
// for supports) go. What has no colour gets that of its extruder. `part` is the package's main model file.
void apply_prusa_volumes(const XmlFile& settings, const std::string& part, const ExtruderColours& extruders,
                         Assembly& assembly);

// Bambu Studio and OrcaSlicer: the same of the components of an object.
void apply_bambu_parts(const XmlFile& settings, const std::string& part, const ExtruderColours& extruders,
                       Assembly& assembly);

}  // namespace ombre::formats
