// Reads the meshes that designs name, and builds what else they need.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "compile/cad_loader.h"
#include "compile/image_loader.h"
#include "compile/shape_loader.h"
#include "design/source_loader.h"
#include "import/path_source.h"

namespace ombre::compile {

class MeshLoader : public design::SourceLoader {
 public:
  explicit MeshLoader(const StopFlag* stop = nullptr) : cad_files_(stop) {}

  // A relative path is looked for beside the file that names it, then in the working directory.
  // Each file is read once for each way in which it is used. Open or inconsistent meshes are errors unless the rule
  // can do without.
  std::vector<design::MeshPart> mesh(std::string& path, const design::MeshUse& use,
                                     const design::Reader& reader) override;
  std::vector<design::CadPart> cad(std::string& path, const design::CadUse& use, const design::Reader& reader) override;
  design::PendingSourcePtr support(const design::NodePtr& solid, const design::SupportUse& use,
                                   const design::Reader& reader) override;
  program::SourceField polygons(Polygons polygons, bool turns, const design::Reader& reader) override {
    return load_polygons(std::move(polygons), turns, reader);
  }
  program::SourceField path(const std::vector<Vec3>& points) override { return importing::make_path_source(points); }
  design::HeightImage heights(design::FilePath& path, const design::Reader& reader) override {
    return load_heights(path, reader);
  }
  program::SourceField text(design::FontName& font, const design::TextUse& use, const design::Reader& reader) override {
    return load_text(font, use, reader);
  }

 private:
  std::vector<design::MeshPart> read(const std::string& path, const design::MeshUse& use,
                                     const design::Reader& reader) const;

  std::map<std::vector<std::string>, std::vector<design::MeshPart>> known_;
  CadFiles cad_files_;
};

}  // namespace ombre::compile
