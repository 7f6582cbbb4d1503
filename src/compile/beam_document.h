// Beams of a design as a mesh file holds them.
#pragma once

#include "compile/mesh_job.h"
#include "formats/mesh_document.h"

namespace ombre::compile {

// Moves beams and what clips them into a document that has the bodies, and their materials in the same order.
void add_beams(MeshedDesign& made, const design::MaterialTable& materials, formats::MeshDocument& document);

}  // namespace ombre::compile
