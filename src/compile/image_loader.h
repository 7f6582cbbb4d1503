// Images of designs as field sources.
#pragma once

#include "design/source_loader.h"

namespace ombre::compile {

// A PNG file, looked for as meshes are. No source, and diagnostics, when it is missing or wrong.
design::HeightImage load_heights(design::FilePath& path, const design::Reader& reader);

}  // namespace ombre::compile
