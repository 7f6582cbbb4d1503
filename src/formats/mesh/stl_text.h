// Reads STL as text.
#pragma once

#include "formats/mesh/mesh.h"

namespace ombre::formats {

// Reads the solids of a text. Errors are reported, and DesignError is thrown.
Mesh read_stl_text(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats
