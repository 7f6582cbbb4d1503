// Reads 3MF: finds the model in the archive, and the parts that it refers to.
#ifdef OMBRE_3MF

#include "base/text/text.h"
#include "formats/containers/text_scanner.h"
#include "formats/containers/zip_archive.h"
#include "formats/packages/mesh_formats.h"
#include "formats/packages/package_readers.h"
#include "formats/packages/three_mf_model.h"
#include "formats/packages/three_mf_text.h"
#include "formats/packages/three_mf_volumes.h"
#include "formats/slicers/bambu_project.h"
#include "formats/slicers/prusa_project.h"

namespace ombre::formats {
namespace {

constexpr const char* relationships_path = "_rels/.rels";
constexpr std::string_view model_relationship = "/3dmodel";

class ThreeMfReader {
 public:
  ThreeMfReader(const std::string& name, std::string_view bytes, Diagnostics& diagnostics)
      : name_(name), diagnostics_(diagnostics), archive_(name, bytes, diagnostics) {}

  Mesh read() {
    const std::string root = root_model();
    read_part(root, true);
    while (!further_.empty()) {
      const std::string part = *further_.begin();
      further_.erase(further_.begin());
      if (!read_.contains(part)) read_part(part, false);
    }
    const auto of_prusa = ExtruderColours::of_prusa(text_of(prusa_project_path));
    const auto of_bambu = ExtruderColours::of_bambu(text_of(bambu_project_path));
    apply(prusa_settings_path, apply_prusa_volumes, of_prusa, root);
    apply(bambu_settings_path, apply_bambu_parts, of_bambu, root);
    paint_surfaces(archive_.has(bambu_project_path) ? of_bambu : of_prusa);
    Mesh mesh = assemble(assembly_, name_, diagnostics_);
    for (MeshImage& image : mesh.images) image.bytes = archive_.read(image.name);
    return mesh;
  }

 private:
  // Returns the file in the archive that the package refers to as its model.
  std::string root_model() {
    const std::string text = text_of(relationships_path);
    if (text.empty()) return only_model("it has no file \"" + std::string(relationships_path) + '"');
    const XmlFile file(name_ + '/' + relationships_path, text, diagnostics_);
    for (const pugi::xml_node node : file.root("Relationships").children()) {
      const std::string_view type = file.attribute(node, "Type").value_or("");
      if (local_name(node) != "Relationship" || !type.ends_with(model_relationship)) continue;
      const std::string_view target = file.required(node, "Target");
      return std::string(target.starts_with('/') ? target.substr(1) : target);
    }
    return only_model(std::string(relationships_path) + " lacks a relationship of the type 3dmodel");
  }

  // Returns the only model of a package that does not refer to its model; fails if there are several.
  std::string only_model(const std::string& fault) {
    std::vector<std::string> models = names_ending({".model"});
    if (models.size() == 1) {
      diagnostics_.warning({}, name_ + ": " + fault + "; the model " + formats::quoted(models[0]) + " is read");
      return models[0];
    }
    const std::vector<std::string> meshes = names_ending(read_mesh_endings());
    std::string hint = "save it again";
    if (!meshes.empty()) hint = "it holds " + formats::quoted(meshes[0]) + ": unpack it";
    if (!meshes.empty() && to_lower(meshes[0]).ends_with(".amf")) hint = "name it .amf if it is a zipped AMF file";
    fail(diagnostics_, name_, "this zip archive is not a 3MF file: " + fault, hint);
  }

  std::vector<std::string> names_ending(const std::vector<std::string>& endings) const {
    std::vector<std::string> found;
    for (const std::string& name : archive_.names())
      for (const std::string& ending : endings)
        if (to_lower(name).ends_with(ending)) found.push_back(name);
    return found;
  }

  void read_part(const std::string& part, bool is_root) {
    const std::string text = archive_.read(part);
    const XmlFile file(name_ + '/' + part, text, diagnostics_);
    read_.insert(part);
    add_objects(file, part, assembly_, further_);
    if (is_root) add_build(file, part, assembly_, further_);
  }

  // Returns the text of an entry; empty if the archive lacks it.
  std::string text_of(const char* entry) { return archive_.has(entry) ? archive_.read(entry) : ""; }

  // Applies a slicer's settings file, if the archive has it.
  void apply(const char* entry, void (*settings)(const XmlFile&, const std::string&, const ExtruderColours&, Assembly&),
             const ExtruderColours& extruders, const std::string& root) {
    if (!archive_.has(entry)) return;
    const std::string text = archive_.read(entry);
    settings(XmlFile(name_ + '/' + entry, text, diagnostics_), root, extruders, assembly_);
  }

  void paint_surfaces(const ExtruderColours& extruders) {
    uint32_t unknown = 0;
    for (auto& [key, object] : assembly_.objects)
      unknown = std::max(unknown, extruders.paint_surfaces(object.mesh.groups));
    if (unknown == 0) return;
    diagnostics_.warning({}, name_ + ": triangles are painted with extruder " + std::to_string(unknown) +
                                 ", whose colour the file does not say; they have none");
  }

  const std::string& name_;
  Diagnostics& diagnostics_;
  ZipReader archive_;
  Assembly assembly_;
  std::set<std::string> read_, further_;  // parts of the package
};

}  // namespace

std::optional<Mesh> read_3mf(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  return read_or_null(name, bytes, diagnostics, [&] {
    if (!is_zip(bytes)) fail(diagnostics, name, "this is not a 3MF file: those are zip archives");
    return ThreeMfReader(name, bytes, diagnostics).read();
  });
}

}  // namespace ombre::formats

#endif
