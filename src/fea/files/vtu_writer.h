// Unstructured grids of VTK, which ParaView, PyVista and meshio read.
#pragma once

#include <vector>

#include "fea/files/sink.h"
#include "fea/model/model.h"

namespace ombre::fea {

// Writes hexahedra or tetrahedra, with values of elements as cell data and values of nodes as point data. Values are
// floats, nodes doubles, as raw bytes after the XML. A unit follows the name of its field: "stress [MPa]".
void write_vtu(const MeshView& mesh, const std::vector<ValueField>& of_elements,
               const std::vector<ValueField>& of_nodes, const Sink& sink);

}  // namespace ombre::fea
