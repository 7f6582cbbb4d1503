// Warns of extensions in a 3MF model that are not supported. Only for builds with pugixml.
#pragma once

#include "formats/containers/xml_file.h"

namespace ombre::formats {

// Warns of each extension that the model requires or uses, unless it is supported or does not affect shapes and
// materials.
void warn_of_extensions(const XmlFile& file, pugi::xml_node model);

}  // namespace ombre::formats
