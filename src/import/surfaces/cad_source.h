// Solids of CAD files as field sources, with the channels "inside" and "distance".
#pragma once

#include <string>
#include <vector>

#include "base/system/hash.h"
#include "cad/solids.h"
#include "import/surfaces/open_edges.h"
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
  // Of an exact source: the space where triangles leave a doubt, and points spread over it.
  double doubtful_mm3 = 0;
  std::vector<Vec3> doubtful_points = {};
};

// Their triangles at this deflection, with exact rows.
CadSource make_triangle_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                               double deflection_mm);

// The surfaces themselves. Triangles at this deflection show where the library's test for inside is not needed.
// Gaps between these matter if they are wider than the band in which the library decides.
CadSource make_exact_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                            double deflection_mm);

// About how long an exact source takes to say whether one of its doubtful points is inside, by a sample of these.
double measure_doubtful_seconds(const CadSource& exact);

}  // namespace ombre::importing
