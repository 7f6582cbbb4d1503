// Solids swept by regions, and regions that solids leave in a plane.
#pragma once

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

// Upward along z, or along a direction that has an upward part. Quads between slices are cut
// along their shorter diagonal. Empty without a height.
TriangleMesh extruded(const Region& region, const LinearExtrude& by);
// About the y axis, which becomes z. All points must lie on one side of it: else an error at `where`, and nothing.
TriangleMesh revolved(const Region& region, const RotateExtrude& by, const SourceRange& where, Diagnostics& messages);

// Where a closed mesh meets the plane z = 0; faces in the plane count.
Region section(const TriangleMesh& mesh);
// The shadow of a closed mesh along z.
Region shadow(const TriangleMesh& mesh);

}  // namespace ombre::solids
