#include "sources/mesh_materials.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/text/file_ending.h"
#include "base/text/json.h"
#include "base/text/text.h"
#include "design/nearest_material.h"
#include "formats/mesh/mesh_objects.h"
#include "lang/openscad/colours.h"
#include "solids/colour_bytes.h"
#include "sources/loading.h"

namespace ombre::sources {
namespace {

using design::Material;
using design::Rgba;
using formats::MeshGroup;

// Returns true if the text is this colour. Opacity counts if the text gives it.
bool is_colour(const std::string& text, const Rgba& colour) {
  const auto found = lang::openscad::colour_of(text);
  if (!found) return false;
  const Rgba wanted = solids::bytes_of(*found);
  return std::equal(wanted.begin(), wanted.begin() + 3, colour.begin()) && (wanted[3] == 255 || wanted[3] == colour[3]);
}

class MaterialFinder {
 public:
  MaterialFinder(const GroupedFile& file, const std::vector<MeshGroup>& groups, const design::MeshUse& use,
                 const design::Reader& reader)
      : file_(file), groups_(groups), use_(use), reader_(reader) {}

  // Returns a material for each group; null if its name is unknown.
  std::vector<const Material*> find() {
    std::vector<const Material*> found;
    for (const MeshGroup& group : groups_) found.push_back(find(group));
    return found;
  }

  // Returns false, with a diagnostic, if the file lacks the requested information, or a name of the map.
  bool check() const {
    const bool by_colours = use_.materials == "colours", has_names = any(&has_name), has_colours = any(&has_colour);
    if (!(by_colours ? has_colours || has_mapped_name() : has_names || has_mapped_name())) {
      Phrase hint = "leave materials out, or " + file_.remedy;
      if (by_colours && has_names)
        hint = "write " + spelled::parameter("materials", "\"names\"") + ": it names materials";
      if (!by_colours && has_colours)
        hint = "write " + spelled::parameter("materials", "\"colours\"") + " to take those of the nearest colours";
      return fail(file_name() + (by_colours ? " gives no colours" : " names no materials"), hint);
    }
    return check_map();
  }

 private:
  std::string file_name() const { return file_.kind + " \"" + file_.path + '"'; }
  static bool has_name(const MeshGroup& group) { return !group.material.empty(); }
  static bool has_colour(const MeshGroup& group) { return group.colour.has_value(); }
  bool any(bool (*is_so)(const MeshGroup&)) const { return std::any_of(groups_.begin(), groups_.end(), is_so); }
  bool has_mapped_name() const {
    return std::any_of(groups_.begin(), groups_.end(), [&](const MeshGroup& g) { return mapped(g); });
  }

  bool fail(const std::string& message, const Phrase& hint) const {
    reader_.diagnostics.error(reader_.where, message, hint);
    return false;
  }

  // Returns the names that a material map may have: those of materials, then colours.
  std::vector<std::string> names_of_file() const {
    std::vector<std::string> names;
    std::set<std::string> known;
    for (const MeshGroup& group : groups_)
      if (has_name(group) && known.insert(group.material).second) names.push_back(group.material);
    for (const MeshGroup& group : groups_) {
      if (!has_colour(group)) continue;
      const std::string colour = lang::openscad::colour_name(*group.colour);
      if (known.insert(colour).second) names.push_back(colour);
    }
    return names;
  }

  bool check_map() const {
    bool good = true;
    for (const auto& entry : use_.material_map) {
      const std::string& name = entry.name;
      if (std::ranges::any_of(groups_, [&](const MeshGroup& g) { return means(name, g.material, g.colour); })) continue;
      good = fail("material_map of " + file_.node + ": " + file_name() + " has no material \"" + name + '"',
                  hint_of_names(name, names_of_file(), "it has no materials: leave material_map out"));
    }
    return good;
  }

  // Returns the material that the map gives to a group, or null. Names of materials count before colours.
  const Material* mapped(const MeshGroup& group) const {
    for (const auto& [name, material] : use_.material_map)
      if (has_name(group) && name == group.material) return material.material;
    for (const auto& [name, material] : use_.material_map)
      if (means(name, "", group.colour)) return material.material;
    return nullptr;
  }

  const Material* find(const MeshGroup& group) {
    if (const Material* material = mapped(group)) return material;
    if (use_.materials == "colours")
      return group.colour ? &design::nearest_material(*group.colour, reader_.materials) : use_.material.material;
    if (group.material.empty()) return use_.material.material;
    const Material* material = reader_.materials.find(group.material);
    if (!material && unknown_.insert(group.material).second) report_unknown(group);
    return material;
  }

  void report_unknown(const MeshGroup& group) const {
    std::string message = file_name() + " has the material \"" + group.material + '"';
    if (!group.name.empty() && group.name != group.material) message += " (of \"" + group.name + "\")";
    Phrase hint = "there are " + join(reader_.materials.names(), ", ") + ": write for example " + example(group);
    if (group.colour)
      hint = hint + ", or " + spelled::parameter("materials", "\"colours\"") + " for those of the nearest colours";
    fail(message + ", which is not among the design's", hint);
  }

  // Returns what gives the group a material: an option if the script is the design, else a parameter of its call.
  Phrase example(const MeshGroup& group) const {
    const std::string& material = reader_.materials.first().name;
    if (is_design_itself(file_.path, reader_))
      return spelled::option("--material-map", '"' + group.material + '=' + material + '"');
    return spelled::parameter("material_map", "[[\"" + group.material + "\", \"" + material + "\"]]");
  }

  const GroupedFile& file_;
  const std::vector<MeshGroup>& groups_;
  const design::MeshUse& use_;
  const design::Reader& reader_;
  std::set<std::string> unknown_;
};

}  // namespace

namespace {

// Bodies with names can be selected individually.
Phrase remedy_of(const formats::Mesh& mesh) {
  const std::string other = "use a 3MF, AMF or OBJ file that has them";
  const std::vector<std::string> names = formats::object_names(mesh);
  if (formats::all_groups(mesh).size() < 2 || names.size() < 2) return other;
  // The hint names the last two, which are bodies even if the first name stands for their union.
  return "give each of its bodies a mesh and a material of its own, with " +
         spelled::parameter("object", '"' + names[names.size() - 2] + '"') + ", " +
         spelled::parameter("object", '"' + names.back() + '"') + " and so on, or " + other;
}

}  // namespace

bool means(const std::string& name, const std::string& material, const std::optional<Rgba>& colour) {
  return (!material.empty() && name == material) || (colour && is_colour(name, *colour));
}

bool is_design_itself(const std::string& path, const design::Reader& reader) {
  const SourcePtr& design = reader.where.source;
  return design && ending_of(path) == ".scad" && design->name().ends_with(path);
}

std::optional<std::vector<const Material*>> find_materials(const GroupedFile& file,
                                                           const std::vector<MeshGroup>& groups,
                                                           const design::MeshUse& use, const design::Reader& reader) {
  MaterialFinder finder(file, groups, use, reader);
  if (!finder.check()) return std::nullopt;
  std::vector<const Material*> materials = finder.find();
  if (std::find(materials.begin(), materials.end(), nullptr) != materials.end()) return std::nullopt;
  return materials;
}

std::optional<std::vector<MaterialMesh>> by_material(const std::string& path, const formats::Mesh& mesh,
                                                     const design::MeshUse& use, const design::Reader& reader) {
  const auto materials =
      find_materials({kind_of(path), ending_of(path) == ".scad" ? "scad" : "mesh", path, remedy_of(mesh)},
                     formats::all_groups(mesh), use, reader);
  if (!materials) return std::nullopt;
  std::vector<MaterialMesh> parts;
  std::set<const Material*> done;
  for (const Material* material : *materials) {
    if (!done.insert(material).second) continue;
    std::vector<bool> flags;
    for (const Material* other : *materials) flags.push_back(other == material);
    parts.push_back({{material}, formats::groups_of(mesh, flags)});
  }
  return parts;
}

void add_use(Key& key, const design::MeshUse& use, const design::Reader& reader) {
  key.add(use.object).add(use.materials.text());
  key.add(use.material.material == &reader.materials.first() ? "usual" : "named");  // for what is said of colours
  if (use.materials == "one") return;
  key.add(print_json_line(reader.materials.to_data())).add(use.material.material->name);
  for (const auto& [name, material] : use.material_map) key.add(name).add(material.material->name);
}

std::string kind_of(const std::string& path) { return ending_of(path) == ".scad" ? "the script" : "the mesh"; }

}  // namespace ombre::sources
