// Models and solutions as XDMF 3 with HDF5, which ParaView and FEniCSx read.
#pragma once

#include <string>
#include <vector>

#include "fea/model/model.h"

namespace ombre::compile {

struct XdmfFiles {
  std::string xdmf;     // the text, which names the other file
  std::string numbers;  // the file of HDF5
};

// One uniform grid called "mesh", its fields with their units in brackets. `numbers_name` is the name that the file of
// HDF5 will have beside the other. The same bytes for the same model. Throws Error without HDF5.
XdmfFiles fea_xdmf(const fea::MeshView& mesh, const std::vector<fea::ValueField>& of_elements,
                   const std::vector<fea::ValueField>& of_nodes, const std::string& numbers_name);

}  // namespace ombre::compile
