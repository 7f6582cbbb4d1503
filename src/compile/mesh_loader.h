// Reads the meshes that designs name.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compile/cad_loader.h"
#include "design/source_loader.h"

namespace ombre::compile {

class MeshLoader : public design::SourceLoader {
 public:
  // A relative path is looked for beside the file that names it, then in the working directory.
  // Each file is read once for each way in which it is used. Open or inconsistent meshes are errors unless the rule
  // can do without.
  std::vector<design::MeshPart> mesh(std::string& path, const design::MeshUse& use,
                                     const design::Reader& reader) override;
  std::vector<design::CadPart> cad(std::string& path, const design::CadUse& use, const design::Reader& reader) override;
  design::PendingSourcePtr support(const design::NodePtr& solid, const design::SupportUse& use,
                                   const design::Reader& reader) override;

 private:
  std::vector<design::MeshPart> read(const std::string& path, const design::MeshUse& use,
                                     const design::Reader& reader) const;

  std::map<std::vector<std::string>, std::vector<design::MeshPart>> known_;
  CadFiles cad_files_;
};

}  // namespace ombre::compile
