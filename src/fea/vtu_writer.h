// Unstructured grids of VTK, which ParaView, PyVista and meshio read.
#pragma once

#include <vector>

#include "fea/model.h"
#include "fea/sink.h"

namespace ombre::fea {

// Hexahedra, with values of bricks as cell data and of nodes as point data, in floats, and the nodes in doubles; raw
// bytes after the XML. Units stand behind the names of fields that have one: "stress [MPa]".
void write_vtu(const Bricks& bricks, const std::vector<ValueField>& of_bricks, const std::vector<ValueField>& of_nodes,
               const Sink& sink);

}  // namespace ombre::fea
