#include "compile/mesh_loader.h"

#include "base/error.h"
#include "base/text.h"
#include "compile/find_file.h"
#include "compile/mesh_closing.h"
#include "compile/mesh_materials.h"
#include "compile/support_source.h"
#include "formats/file.h"
#include "formats/mesh_objects.h"
#include "import/beam_source.h"
#include "import/combined_source.h"
#include "import/mesh_source.h"

namespace ombre::compile {
namespace {

importing::InsideRule rule_of(std::string_view name) {
  if (name == "parity") return importing::InsideRule::parity;
  return name == "generalized" ? importing::InsideRule::generalized : importing::InsideRule::nonzero;
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

formats::Mesh moved(formats::Mesh mesh, const Affine& map) {
  for (Vec3& p : mesh.vertices) p = map(p);
  if (determinant(map) < 0)
    for (auto& [a, b, c] : mesh.triangles) std::swap(b, c);
  return mesh;
}

program::SourceField source_of(const std::string& path, const formats::PlacedLattice& placed, Hash content,
                               importing::InsideRule rule) {
  program::SourceField beams = importing::make_beam_source(path, placed, content);
  const formats::BeamLattice& lattice = *placed.lattice;
  if (!lattice.clip) return beams;
  program::SourceField clip =
      importing::make_mesh_source(path, moved(*lattice.clip, placed.mm_from_lattice), content, {rule});
  return importing::make_clipped_source(beams, clip, lattice.clipping == formats::LatticeClipping::inside);
}

// The triangles and the lattices of one material. `content` is the hash of what they are.
design::MeshPart part_of(const std::string& path, MaterialMesh part, Hash content, importing::InsideRule rule) {
  std::vector<program::SourceField> sources;
  const std::vector<formats::PlacedLattice> lattices = std::move(part.mesh.lattices);
  if (!part.mesh.triangles.empty())
    sources.push_back(importing::make_mesh_source(path, std::move(part.mesh), content, {rule}));
  for (size_t n = 0; n < lattices.size(); ++n)
    sources.push_back(source_of(path, lattices[n], hash_bytes(content.hex() + " lattice " + std::to_string(n)), rule));
  return {part.material, importing::make_union_source(std::move(sources)), lattices.empty()};
}

std::optional<std::vector<MaterialMesh>> read_parts(const std::string& path, std::string_view bytes,
                                                    const design::MeshUse& use, const design::Reader& reader) {
  auto mesh = formats::read_mesh(path, bytes, reader.diagnostics);
  if (!mesh) {
    reader.diagnostics.note(reader.where, "the file is used here");
    return std::nullopt;
  }
  if (!choose_object(path, *mesh, use.object, reader)) return std::nullopt;
  if (!make_closed(mesh_called(path), *mesh, use.inside.text(), reader)) return std::nullopt;
  if (!close_clips(path, *mesh, use.inside.text(), reader)) return std::nullopt;
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
    parts.push_back(part_of(path, std::move(part), own, rule_of(use.inside.text())));
  }
  if (parts[0].source->channel("distance") >= 0) return parts;
  reader.diagnostics.error(reader.where, "meshes are not available: this build has no library for their distances");
  return {};
}

}  // namespace ombre::compile
