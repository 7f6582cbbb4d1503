#include "compile/mesh_loader.h"

#include "base/error.h"
#include "base/text.h"
#include "compile/find_file.h"
#include "compile/mesh_materials.h"
#include "compile/support_source.h"
#include "formats/file.h"
#include "formats/mesh_objects.h"
#include "import/corner_welder.h"
#include "import/mesh_source.h"
#include "import/shells.h"

namespace ombre::compile {
namespace {

importing::InsideRule rule_of(std::string_view name) {
  if (name == "parity") return importing::InsideRule::parity;
  return name == "generalized" ? importing::InsideRule::generalized : importing::InsideRule::nonzero;
}

std::string point_text(Vec3 p) {
  return "(" + format_rounded(p.x) + ", " + format_rounded(p.y) + ", " + format_rounded(p.z) + ")";
}

bool has_inside(const importing::MeshReport& report, std::string_view rule) {
  return report.is_closed() || rule == "generalized" || (rule == "parity" && report.open_edges == 0);
}

// "is open along 4 edges, for example from ... to ..."
std::string faults(const importing::MeshReport& report) {
  std::string message;
  if (report.open_edges > 0)
    message = "is open along " + format_count(report.open_edges) + (report.open_edges == 1 ? " edge" : " edges");
  if (report.inconsistent_edges > 0)
    message += std::string(report.open_edges > 0 ? " and " : "") + "has triangles facing different ways along " +
               format_count(report.inconsistent_edges) + (report.inconsistent_edges == 1 ? " edge" : " edges");
  if (!report.examples.empty())
    message += ", for example from " + point_text(report.examples[0][0]) + " to " + point_text(report.examples[0][1]);
  return message;
}

// Where the surface is open because corners differ by rounding.
void join_corners(const std::string& path, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader,
                  importing::MeshReport& report) {
  const size_t open_edges = report.open_edges;
  const auto welded = importing::weld_corners(mesh, rule == "parity");
  if (!welded) return;
  reader.diagnostics.note(reader.where, format_count(welded->corners) + " corners of the mesh \"" + path +
                                            "\" that lie up to " + format_rounded(welded->farthest_mm, 2) +
                                            " mm apart were joined: the surface was open along " +
                                            format_count(open_edges) + (open_edges == 1 ? " edge" : " edges"));
  report = importing::inspect(mesh);
}

// Shells that face inward and overlap others that face outward would cancel them out.
void turn_shells(const std::string& path, formats::Mesh& mesh, const design::Reader& reader) {
  const auto [turned, shells] = importing::turn_inverted_shells(mesh);
  if (turned == 0) return;
  const bool is_one = turned == 1;
  reader.diagnostics.warning(reader.where, format_count(turned) + " of the " + format_count(shells) +
                                               " shells of the mesh \"" + path + "\" " + (is_one ? "faces" : "face") +
                                               " inward, where others face outward, and " + (is_one ? "lies" : "lie") +
                                               " in none of them; " + (is_one ? "it is" : "they are") +
                                               " turned round");
}

// False, and a diagnostic, when the mesh has no inside under the rule. Small faults are mended.
bool make_closed(const std::string& path, formats::Mesh& mesh, std::string_view rule, const design::Reader& reader) {
  importing::MeshReport report = importing::inspect(mesh);
  if (!has_inside(report, rule)) join_corners(path, mesh, rule, reader, report);
  if (!has_inside(report, rule)) {
    const std::string hint = report.open_edges > 0
                                 ? "repair it, or write inside=\"generalized\" to close it by winding number"
                                 : "repair it, or write inside=\"parity\" to ignore which way triangles face";
    reader.diagnostics.error(reader.where, "the mesh \"" + path + "\" " + faults(report), hint);
    return false;
  }
  if (rule != "parity" && report.inward_shells > 0 && report.inward_shells < report.shells)
    turn_shells(path, mesh, reader);
  return true;
}

// The same for what a file has of one material, when the whole is closed.
bool check_part_closed(const std::string& path, const MaterialMesh& part, std::string_view rule,
                       const design::Reader& reader) {
  const importing::MeshReport report = importing::inspect(part.mesh);
  if (has_inside(report, rule)) return true;
  reader.diagnostics.error(
      reader.where, "what the mesh \"" + path + "\" has of \"" + part.material.material->name + "\" " + faults(report),
      "save a closed body for each material, or leave materials out to have one");
  return false;
}

// False, and a diagnostic, when the file has no object of that name.
bool choose_object(const std::string& path, formats::Mesh& mesh, const std::string& object,
                   const design::Reader& reader) {
  if (object.empty() || formats::keep_object(mesh, object)) return true;
  constexpr size_t most_listed = 20;
  std::vector<std::string> names = formats::object_names(mesh);
  std::string hint = did_you_mean(object, names);
  const bool is_cut = names.size() > most_listed;
  if (is_cut) names.resize(most_listed);
  if (hint.empty())
    hint = names.empty() ? "its objects have no names: leave object out"
                         : "there are \"" + join(names, "\", \"") + '"' + (is_cut ? " and more" : "");
  reader.diagnostics.error(reader.where, "the mesh \"" + path + "\" has no object \"" + object + '"', hint);
  return false;
}

// What decides the parts that a file gives.
std::vector<std::string> key_of(const std::string& path, const design::MeshUse& use) {
  std::vector<std::string> key{path, use.object, std::string(use.inside.text()), std::string(use.materials.text())};
  if (use.materials == "one") return key;
  key.push_back(use.material.material->name);
  for (const auto& [name, material] : use.material_map) {
    key.push_back(name);
    key.push_back(material.material->name);
  }
  return key;
}

std::optional<std::vector<MaterialMesh>> read_parts(const std::string& path, std::string_view bytes,
                                                    const design::MeshUse& use, const design::Reader& reader) {
  auto mesh = formats::read_mesh(path, bytes, reader.diagnostics);
  if (!mesh) {
    reader.diagnostics.note(reader.where, "the file is used here");
    return std::nullopt;
  }
  if (!choose_object(path, *mesh, use.object, reader)) return std::nullopt;
  if (!make_closed(path, *mesh, use.inside.text(), reader)) return std::nullopt;
  std::vector<MaterialMesh> parts;
  if (use.materials == "one") {
    parts.push_back({use.material, std::move(*mesh)});
    return parts;
  }
  auto found = by_material(path, *mesh, use, reader);
  if (!found) return std::nullopt;
  for (const MaterialMesh& part : *found)
    if (!check_part_closed(path, part, use.inside.text(), reader)) return std::nullopt;
  return found;
}

}  // namespace

std::vector<design::MeshPart> MeshLoader::mesh(std::string& path, const design::MeshUse& use,
                                               const design::Reader& reader) {
  const auto found = find_file(path, reader.where, reader.diagnostics);
  if (!found) return {};
  path = *found;
  if (cad::is_cad_file(path)) {
    reader.diagnostics.error(reader.where, "\"" + path + "\" is no mesh but a CAD file", "write cad in place of mesh");
    return {};
  }
  std::vector<design::MeshPart>& parts = known_[key_of(path, use)];
  if (parts.empty()) parts = read(path, use, reader);
  std::vector<design::MeshPart> result = parts;
  if (use.materials == "one" && !result.empty()) result[0].material = use.material;
  return result;
}

std::vector<design::CadPart> MeshLoader::cad(std::string& path, const design::CadUse& use,
                                             const design::Reader& reader) {
  const auto found = find_file(path, reader.where, reader.diagnostics);
  if (!found) return {};
  path = *found;
  return cad_files_.parts(path, use, reader);
}

design::PendingSourcePtr MeshLoader::support(const design::NodePtr& solid, const design::SupportUse& use,
                                             const design::Reader& reader) {
  return make_support_source(solid, use, reader);
}

std::vector<design::MeshPart> MeshLoader::read(const std::string& path, const design::MeshUse& use,
                                               const design::Reader& reader) const {
  std::string bytes;
  try {
    bytes = formats::read_file(path);
  } catch (const Error& error) {
    reader.diagnostics.error(reader.where, error.what());
    return {};
  }
  auto meshes = read_parts(path, bytes, use, reader);
  if (!meshes) return {};
  Hash content = hash_bytes(bytes);
  if (!use.object.empty()) content = hash_bytes(content.hex() + use.object);
  std::vector<design::MeshPart> parts;
  for (MaterialMesh& part : *meshes) {
    const Hash own = use.materials == "one" ? content : hash_bytes(content.hex() + part.material.material->name);
    parts.push_back(
        {part.material, importing::make_mesh_source(path, std::move(part.mesh), own, {rule_of(use.inside.text())})});
  }
  if (parts[0].source->channel("distance") >= 0) return parts;
  reader.diagnostics.error(reader.where, "meshes are not available: this build has no library for their distances");
  return {};
}

}  // namespace ombre::compile
