// Reads the CAD files that designs name.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cad/solids.h"
#include "design/source_loader.h"

namespace ombre::compile {

// Each file is read once.
class CadFiles {
 public:
  // Reading stops once `stop`, which may be null, is set.
  explicit CadFiles(const StopFlag* stop) : stop_(stop) {}

  // As SourceLoader::cad() has it; `path` is where the file is.
  std::vector<design::CadPart> parts(const std::string& path, const design::CadUse& use, const design::Reader& reader);

 private:
  struct File {
    Hash content;
    std::vector<cad::SolidPtr> solids;
  };
  const File* file(const std::string& path, const design::Reader& reader);

  const StopFlag* stop_;
  std::map<std::string, File> files_;
};

}  // namespace ombre::compile
