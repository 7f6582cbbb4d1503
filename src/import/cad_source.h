// Solids of CAD files as field sources, with the channels "inside" and "distance".
#pragma once

#include <string>
#include <vector>

#include "base/hash.h"
#include "cad/solids.h"
#include "program/field_source.h"

namespace ombre::importing {

// Their triangles at this deflection, with exact rows.
program::SourceField make_triangle_source(const std::string& name, const std::vector<cad::SolidPtr>& solids,
                                          Hash content, double deflection_mm);

// The surfaces themselves. Triangles at this deflection tell where the library need not be asked what is inside.
program::SourceField make_exact_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                                       double deflection_mm);

}  // namespace ombre::importing
