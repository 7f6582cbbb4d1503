// Meshes whose borders several processes look for, each in slabs of the grid's cells. The surface is made of them all
// when they are joined.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "jobs/common/shared_job.h"
#include "jobs/mesh/planned_mesh.h"
#include "surface/cells/grid_borders.h"

namespace ombre::jobs {

struct MeshToShare {
  std::string folder;  // of the slabs, until they are joined
  compile::PlannedMesh planned;
  stores::JobKey key;                // all that decides the mesh
  std::vector<std::string> written;  // paths of the files to write
  // Makes the mesh of what is known of its borders, and writes it; returns an exit code.
  std::function<int(const compile::PlannedMesh& planned, const surface::GridBorders& known, Session& session)> write;
};

SharedJobPtr share_mesh(MeshToShare mesh);

}  // namespace ombre::jobs
