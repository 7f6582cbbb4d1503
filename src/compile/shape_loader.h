// Polygons and texts of designs as field sources.
#pragma once

#include "design/source_loader.h"

namespace ombre::compile {

program::SourceField load_polygons(Polygons polygons, bool turns, const design::Reader& reader);
// A font that is a path is looked for as meshes are; one that is not found, or lacks letters, is a warning.
program::SourceField load_text(design::FontName& font, const design::TextUse& use, const design::Reader& reader);

}  // namespace ombre::compile
