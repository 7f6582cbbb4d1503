// CAD files as they are read, once for all that is made of them.
#pragma once

#include <memory>
#include <vector>

#include "cad/solids.h"
#include "sources/loading.h"

namespace ombre::sources {

struct CadFile {
  std::vector<cad::SolidPtr> solids;
  size_t bytes = 0;  // memory used
};

// Returns the solids of a file whose content is set; null, with a diagnostic, if it is no CAD file or cannot be read.
std::shared_ptr<const CadFile> read_cad(const design::FilePath& file, Loading& loading);

}  // namespace ombre::sources
