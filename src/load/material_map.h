// Materials for the names that an OpenSCAD script gives its solids, as --material-map says them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/materials.h"
#include "sources/source_cache.h"

namespace ombre::compile {

// Reads "NAME=MATERIAL", where NAME is that of a material in the script, or one of its colours; a text without "=" is
// the path of a JSON file {"NAME": "MATERIAL", ...}. Returns pairs [NAME, MATERIAL], as the parameter material_map has
// them. Returns nothing, and adds diagnostics, if a material is not in the table or a name is there twice. Throws Error
// for files that cannot be read.
std::optional<DataList> read_material_map(const std::vector<std::string>& texts, const design::MaterialTable& materials,
                                          sources::SourceCache& cache, Diagnostics& diagnostics);

}  // namespace ombre::compile
