// Solids swept by regions, and sections and shadows of solids.
#pragma once

#include "base/text/diagnostic.h"
#include "solids/solid.h"

namespace ombre::solids {

// Extrudes a region upward along z, or along a direction with an upward component. Quads between slices are split along
// their shorter diagonal. Empty if the height is not positive.
TriangleMesh extruded(const Region& region, const LinearExtrude& by);
// Revolves a region about the y axis, which becomes z. All points must lie on one side of the axis; otherwise reports
// an error at `where` and returns an empty mesh.
TriangleMesh revolved(const Region& region, const RotateExtrude& by, const SourceRange& where, Diagnostics& messages);

// Returns the section of a closed mesh with the plane z = 0; faces in the plane count.
Region section(const TriangleMesh& mesh);
// Returns the projection of a closed mesh along z.
Region shadow(const TriangleMesh& mesh);

}  // namespace ombre::solids
