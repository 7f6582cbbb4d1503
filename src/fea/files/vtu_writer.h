// Unstructured grids of VTK, which ParaView, PyVista and meshio read.
#pragma once

#include <vector>

#include "fea/files/sink.h"
#include "fea/model/model.h"

namespace ombre::fea {

// Hexahedra or tetrahedra, with values of elements as cell data and of nodes as point data, in floats, and the nodes in
// doubles; raw bytes after the XML. Units stand behind the names of fields that have one: "stress [MPa]".
void write_vtu(const MeshView& mesh, const std::vector<ValueField>& of_elements,
               const std::vector<ValueField>& of_nodes, const Sink& sink);

}  // namespace ombre::fea
