// Solids of CAD files as field sources, with the channels "inside" and "distance".
#pragma once

#include <string>
#include <vector>

#include "base/system/hash.h"
#include "cad/solids.h"
#include "import/surfaces/open_edges.h"
#include "program/field_source.h"

namespace ombre::importing {

// A solid whose triangles are not closed; the generalized winding number decides what is inside.
struct OpenSolid {
  std::string name;  // may be empty
  OpenEdges edges;
};

struct CadSource {
  program::SourceField source;
  std::vector<OpenSolid> open;  // open solids that affect the source
  // Volume of the space where an exact source's triangles leave a doubt, and points spread over it.
  double doubtful_mm3 = 0;
  std::vector<Vec3> doubtful_points = {};
};

// Returns the source of the solids' triangles at this deflection, with exact rows.
CadSource make_triangle_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                               double deflection_mm);

// Returns the source of the exact surfaces. Away from them, triangles at this deflection decide what is inside without
// the library. Gaps between the triangles matter only if they are wider than the band in which the library decides.
CadSource make_exact_source(const std::string& name, const std::vector<cad::SolidPtr>& solids, Hash content,
                            double deflection_mm);

// Returns an estimate of the time in seconds that an exact source takes to decide whether one of its doubtful points is
// inside, measured on a sample of them.
double measure_doubtful_seconds(const CadSource& exact);

}  // namespace ombre::importing
