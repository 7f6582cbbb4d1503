// Triangle meshes as field sources.
#pragma once

#include <string>

#include "base/system/hash.h"
#include "formats/mesh/mesh.h"
#include "import/surfaces/mesh_report.h"
#include "import/surfaces/row_winding.h"
#include "program/field_source.h"

namespace ombre::importing {

struct MeshOptions {
  InsideRule rule = InsideRule::nonzero;
};

// Channels:
//   "inside"    1 inside, 0 outside. Its rows are exact. The rules nonzero and parity need a closed mesh
//               (see inspect) to mean anything.
//   "distance"  mm to the nearest triangle, negative inside. Absent without OMBRE_MESH_DISTANCE.
// A point on a triangle counts as lying a trifle further along +x, +y and +z, so meshes that share a
// face share out the points on it. `content` is the hash of the file's bytes.
program::SourceField make_mesh_source(std::string name, formats::Mesh mesh, Hash content, MeshOptions options = {});

}  // namespace ombre::importing
