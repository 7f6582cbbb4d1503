// Remarks on CAD parts that are added when they are made.
#pragma once

#include <string>
#include <vector>

#include "design/source_loader.h"
#include "import/surfaces/cad_source.h"

namespace ombre::sources {

// Returns the remark on solids whose triangles are not closed at this tolerance; there must be at least one.
design::Remark remark_on_gaps(const std::string& path, const std::vector<importing::OpenSolid>& open,
                              double tolerance_mm, bool is_exact);

// Returns the remark on the time that an exact part takes for this number of voxels; `tolerance_mm` is that of
// triangles as an alternative.
design::Remark remark_on_time(const std::string& path, double voxels, double seconds, double tolerance_mm);

}  // namespace ombre::sources
