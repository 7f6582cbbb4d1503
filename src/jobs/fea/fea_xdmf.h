// Writes models and solutions as XDMF 3 with HDF5, which ParaView and FEniCSx read.
#pragma once

#include <string>
#include <vector>

#include "fea/model/model.h"

namespace ombre::compile {

struct XdmfFiles {
  std::string xdmf;     // the text, which names the other file
  std::string numbers;  // the bytes of the file of HDF5
};

// Makes one uniform grid called "mesh"; units of its fields are in brackets. `numbers_name` is the name that the file
// of HDF5 will have beside the other. The same model gives the same bytes. Throws Error without HDF5.
XdmfFiles fea_xdmf(const fea::MeshView& mesh, const std::vector<fea::ValueField>& of_elements,
                   const std::vector<fea::ValueField>& of_nodes, const std::string& numbers_name);

}  // namespace ombre::compile
