// Puts beams of a design into a document of meshes.
#pragma once

#include "formats/mesh/mesh_document.h"
#include "jobs/mesh/mesh_job.h"

namespace ombre::compile {

// Moves beams and their clips into a document that has the bodies, and their materials in the same order.
void add_beams(MeshedDesign& made, const design::MaterialTable& materials, formats::MeshDocument& document);

}  // namespace ombre::compile
