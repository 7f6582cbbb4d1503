// What a 3MF model has of extensions that are not read. Only for files that are built with pugixml.
#pragma once

#include "formats/containers/xml_file.h"

namespace ombre::formats {

// Warns of each extension that the model requires, or of which it uses elements, unless it is read or has no bearing on
// shapes and materials.
void warn_of_extensions(const XmlFile& file, pugi::xml_node model);

}  // namespace ombre::formats
