// Filaments that are settings of one nozzle: a tool for each temperature and flow.
#pragma once

#include "formats/mesh/mesh_document.h"
#include "jobs/common/events.h"
#include "jobs/mesh/meshed_design.h"

namespace ombre::jobs {

// Gives the document, whose bodies are those of the design, a filament for each pair of temperature and flow of its
// bands, and its bodies the extruders of them. Throws WrongArgument if the bands have neither, or if there are too
// many.
void add_virtual_tools(const compile::MeshedDesign& made, const Events& events, formats::MeshDocument& document);

}  // namespace ombre::jobs
