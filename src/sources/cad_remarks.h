// Remarks on CAD parts once they are made.
#pragma once

#include <string>
#include <vector>

#include "design/source_loader.h"
#include "import/surfaces/cad_source.h"

namespace ombre::sources {

// On solids whose triangles, at this tolerance, do not close; there is one at least.
design::Remark remark_on_gaps(const std::string& path, const std::vector<importing::OpenSolid>& open,
                              double tolerance_mm, bool is_exact);

// On an exact part that will be evaluated at so many voxels; `tolerance_mm` is that of triangles in its place.
design::Remark remark_on_time(const std::string& path, double voxels, double seconds, double tolerance_mm);

}  // namespace ombre::sources
