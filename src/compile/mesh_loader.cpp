#include "compile/mesh_loader.h"

#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "formats/file.h"
#include "formats/mesh_objects.h"
#include "import/mesh_source.h"

namespace ombre::compile {
namespace {

namespace fs = std::filesystem;

// Where the path leads: beside the script first. Nothing, and a diagnostic, when no file is there.
std::optional<std::string> find_file(const std::string& path, const SourceRange& where, Diagnostics& diagnostics) {
  std::error_code ignored;
  const fs::path wanted(path);
  const fs::path script = where.source ? fs::path(where.source->name()) : fs::path();
  const fs::path beside = wanted.is_absolute() ? wanted : script.parent_path() / wanted;
  if (fs::exists(beside, ignored)) return beside.string();
  if (fs::exists(wanted, ignored)) return path;
  std::string looked = beside.string();
  if (beside != wanted && !wanted.is_absolute())
    looked += " and " + fs::absolute(wanted, ignored).lexically_normal().string();
  diagnostics.error(where, "there is no file \"" + path + "\"", "looked for " + looked);
  return std::nullopt;
}

importing::InsideRule rule_of(const std::string& name) {
  if (name == "parity") return importing::InsideRule::parity;
  return name == "generalized" ? importing::InsideRule::generalized : importing::InsideRule::nonzero;
}

std::string point_text(Vec3 p) {
  return "(" + format_rounded(p.x) + ", " + format_rounded(p.y) + ", " + format_rounded(p.z) + ")";
}

// False, and a diagnostic, when the mesh has no inside under the rule.
bool check_closed(const std::string& path, const importing::MeshReport& report, const std::string& rule,
                  const SourceRange& where, Diagnostics& diagnostics) {
  if (report.is_closed() || rule == "generalized") return true;
  if (rule == "parity" && report.open_edges == 0) return true;
  std::string message = "the mesh \"" + path + "\" ";
  if (report.open_edges > 0)
    message += "is open along " + format_count(report.open_edges) + (report.open_edges == 1 ? " edge" : " edges");
  if (report.inconsistent_edges > 0)
    message += std::string(report.open_edges > 0 ? " and " : "") + "has triangles facing different ways along " +
               format_count(report.inconsistent_edges) + (report.inconsistent_edges == 1 ? " edge" : " edges");
  if (!report.examples.empty())
    message += ", for example from " + point_text(report.examples[0][0]) + " to " + point_text(report.examples[0][1]);
  const std::string hint = report.open_edges > 0
                               ? "repair it, or write inside=\"generalized\" to close it by winding number"
                               : "repair it, or write inside=\"parity\" to ignore which way triangles face";
  diagnostics.error(where, message, hint);
  return false;
}

// False, and a diagnostic, when the file has no object of that name.
bool choose_object(const std::string& path, formats::Mesh& mesh, const std::string& object, const SourceRange& where,
                   Diagnostics& diagnostics) {
  if (object.empty() || formats::keep_object(mesh, object)) return true;
  constexpr size_t most_listed = 20;
  std::vector<std::string> names = formats::object_names(mesh);
  std::string hint = did_you_mean(object, names);
  const bool is_cut = names.size() > most_listed;
  if (is_cut) names.resize(most_listed);
  if (hint.empty())
    hint = names.empty() ? "its objects have no names: leave object out"
                         : "there are \"" + join(names, "\", \"") + '"' + (is_cut ? " and more" : "");
  diagnostics.error(where, "the mesh \"" + path + "\" has no object \"" + object + '"', hint);
  return false;
}

}  // namespace

program::SourceField MeshLoader::mesh(std::string& path, const std::string& object, const std::string& inside,
                                      const SourceRange& where, Diagnostics& diagnostics) {
  const auto found = find_file(path, where, diagnostics);
  if (!found) return nullptr;
  path = *found;
  const auto known = known_.find({path, object, inside});
  if (known != known_.end()) return known->second;
  std::string bytes;
  try {
    bytes = formats::read_file(path);
  } catch (const Error& error) {
    diagnostics.error(where, error.what());
    return nullptr;
  }
  Hash content = hash_bytes(bytes);
  if (!object.empty()) content = hash_bytes(content.hex() + object);
  auto mesh = formats::read_mesh(path, bytes, diagnostics);
  if (!mesh) {
    diagnostics.note(where, "the file is used here");
    return nullptr;
  }
  if (!choose_object(path, *mesh, object, where, diagnostics)) return nullptr;
  if (!check_closed(path, importing::inspect(*mesh), inside, where, diagnostics)) return nullptr;
  const program::SourceField source = importing::make_mesh_source(path, std::move(*mesh), content, {rule_of(inside)});
  if (source->channel("distance") < 0) {
    diagnostics.error(where, "meshes are not available: this build has no library for their distances");
    return nullptr;
  }
  known_[{path, object, inside}] = source;
  return source;
}

}  // namespace ombre::compile
