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

// Returns the source of a mesh; `content` is the hash of the file's bytes. Channels:
//   "inside"    1 inside, 0 outside. Its rows are exact. The rules nonzero and parity require a closed mesh
//               (see inspect).
//   "distance"  signed distance in mm to the nearest triangle, negative inside. Absent without OMBRE_MESH_DISTANCE.
// A point on a triangle counts as infinitesimally further along +x, +y and +z, so meshes that share a face divide the
// points on it between them.
program::SourceField make_mesh_source(std::string name, formats::Mesh mesh, Hash content, MeshOptions options = {});

}  // namespace ombre::importing
