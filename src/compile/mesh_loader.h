// Reads the meshes that designs name.
#pragma once

#include <array>
#include <map>
#include <string>

#include "design/source_loader.h"

namespace ombre::compile {

class MeshLoader : public design::SourceLoader {
 public:
  // A relative path is looked for beside the file that names it, then in the working directory.
  // Each file is read once per object and inside rule. Open or inconsistent meshes are errors unless the rule
  // can do without.
  program::SourceField mesh(std::string& path, const std::string& object, const std::string& inside,
                            const SourceRange& where, Diagnostics& diagnostics) override;

 private:
  std::map<std::array<std::string, 3>, program::SourceField> known_;
};

}  // namespace ombre::compile
