// STL as text.
#pragma once

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// What is wrong is reported and ends the reading by DesignError.
Mesh read_stl_text(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats
