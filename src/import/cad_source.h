// Solids of CAD files as field sources, with the channels "inside" and "distance".
#pragma once

#include <string>
#include <vector>

#include "base/hash.h"
#include "cad/solids.h"
#include "import/open_edges.h"
#include "program/field_source.h"

namespace ombre::importing {

// A solid whose triangles do not close. The generalized winding number decides what is inside.
struct OpenSolid {
  std::string name;  // may be empty
  OpenEdges edges;
};

struct CadSource {
  program::SourceField source;
  std::vector<OpenSolid> open;  // those that matter to the source
};

// Their triangles at this deflection, with exact rows.
CadSource make_triangle_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                               double deflection_mm);

// The surfaces themselves. Triangles at this deflection tell where the library need not be asked what is inside.
// Gaps between these matter if they are wider than what the library is asked about.
CadSource make_exact_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                            double deflection_mm);

}  // namespace ombre::importing
