// Loads mesh files for designs.
#include <set>

#include "cad/solids.h"

#include "base/text/file_ending.h"
#include "base/text/text.h"
#include "formats/mesh/mesh_objects.h"
#include "formats/packages/read_mesh.h"
#include "import/fields/beam_source.h"
#include "import/fields/combined_source.h"
#include "import/surfaces/mesh_source.h"
#include "sources/files_of_results.h"
#include "sources/loading.h"
#include "sources/mesh_closing.h"
#include "sources/mesh_materials.h"
#include "sources/result_border.h"

namespace ombre::design {
namespace {

importing::InsideRule rule_of(std::string_view name) {
  if (name == "parity") return importing::InsideRule::parity;
  return name == "generalized" ? importing::InsideRule::generalized : importing::InsideRule::nonzero;
}

// Reduces the mesh to an object. Returns false, with a diagnostic, if the file has none of that name.
bool choose_object(const std::string& path, formats::Mesh& mesh, const std::string& object, const Reader& reader) {
  if (object.empty() || formats::keep_object(mesh, object)) return true;
  reader.diagnostics.error(
      Code::unknown_object, reader.where, "the mesh \"" + path + "\" has no object \"" + object + '"',
      sources::hint_of_names(object, formats::object_names(mesh), "its objects have no names: leave object out"),
      {{"file", path}, {"name", object}});
  return false;
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

// Returns the part of one material, made of its triangles and lattices; `content` is the hash of their contents.
MeshPart part_of(const std::string& path, const std::string& material, formats::Mesh mesh, Hash content,
                 importing::InsideRule rule) {
  std::vector<program::SourceField> sources;
  const std::vector<formats::PlacedLattice> lattices = std::move(mesh.lattices);
  if (!mesh.triangles.empty()) sources.push_back(importing::make_mesh_source(path, std::move(mesh), content, {rule}));
  for (size_t n = 0; n < lattices.size(); ++n)
    sources.push_back(source_of(path, lattices[n], hash_bytes(content.hex() + " lattice " + std::to_string(n)), rule));
  return {material, importing::make_union_source(std::move(sources)), lattices.empty()};
}

// Tells of colours that a mesh file loses: those of its vertices, and those of its bodies if no material is named.
void warn_of_colours(const std::string& path, const formats::Mesh& mesh, const MeshUse& use, const Reader& reader) {
  if (!mesh.vertex_colours.empty())
    reader.diagnostics.warning(reader.where,
                               "the vertices of the mesh \"" + path + "\" have colours, which do not become materials",
                               "surface_colour(\"" + path + "\").colour gives them as a value that varies in space");
  if (!mesh.shadings.empty())
    reader.diagnostics.warning(
        reader.where, "the mesh \"" + path + "\" has textures or shaded triangles, which do not become materials",
        "surface_colour(\"" + path + "\").colour gives them as a value that varies in space");
  const bool is_named = use.material.material != &reader.materials.first();
  if (use.materials != "one" || !use.object.empty() || is_named) return;
  std::set<Rgba> colours;
  std::set<std::string> names;  // of materials, as OBJ files have them
  for (const formats::MeshGroup& group : formats::all_groups(mesh)) {
    if (group.colour) colours.insert(*group.colour);
    if (!group.material.empty()) names.insert(group.material);
  }
  if (colours.size() > 1)
    return reader.diagnostics.warning(
        reader.where,
        "the mesh \"" + path + "\" has bodies of " + std::to_string(colours.size()) +
            " colours, which become one material",
        "write " + spelled::parameter("materials", "\"colours\"") + " to take the materials of the nearest colours");
  if (names.size() > 1)
    reader.diagnostics.warning(
        reader.where, "the mesh \"" + path + "\" has " + std::to_string(names.size()) + " materials, which become one",
        "write " + spelled::parameter("materials", "\"names\"") + " to take the materials of these names, or " +
            "surface_colour(\"" + path + "\").colour for the colours of its .mtl file");
}

std::optional<std::vector<sources::MaterialMesh>> cut_by_use(const std::string& path, formats::Mesh mesh,
                                                             const MeshUse& use, const Reader& reader) {
  if (!choose_object(path, mesh, use.object, reader)) return std::nullopt;
  if (!sources::make_closed(sources::mesh_called(path), mesh, use.inside.text(), reader)) return std::nullopt;
  if (!sources::close_clips(path, mesh, use.inside.text(), reader)) return std::nullopt;
  std::vector<sources::MaterialMesh> parts;
  if (use.materials == "one") {
    parts.push_back({use.material, std::move(mesh)});
    return parts;
  }
  auto found = sources::by_material(path, mesh, use, reader);
  if (!found) return std::nullopt;
  for (const sources::MaterialMesh& part : *found)
    if (!sources::check_part_closed(path, part, use.inside.text(), reader)) return std::nullopt;
  return found;
}

// Returns an estimate of the memory for the mesh, its trees for distances and for inside tests.
size_t bytes_of(const formats::Mesh& mesh) {
  constexpr size_t per_vertex = 24, per_triangle = 250, per_beam = 300;
  size_t bytes = per_vertex * mesh.vertices.size() + per_triangle * mesh.triangles.size();
  for (const formats::PlacedLattice& placed : mesh.lattices) bytes += per_beam * placed.lattice->beams.size();
  return bytes;
}

using MadeParts = sources::Loading::Made<std::vector<MeshPart>>;

// Returns the parts of a mesh; `all` is the hash of the mesh's origin.
MadeParts parts_of(const std::string& path, formats::Mesh mesh, const Hash& all, const MeshUse& use,
                   const Reader& reader) {
  auto meshes = cut_by_use(path, std::move(mesh), use, reader);
  if (!meshes) return {};
  const Hash content = use.object.empty() ? all : hash_bytes(all.hex() + use.object);
  auto parts = std::make_shared<std::vector<MeshPart>>();
  size_t size = 0;
  for (sources::MaterialMesh& part : *meshes) {
    size += bytes_of(part.mesh);
    const std::string material = use.materials == "one" ? "" : part.material.material->name;
    const Hash own = material.empty() ? content : hash_bytes(content.hex() + material);
    parts->push_back(part_of(path, material, std::move(part.mesh), own, rule_of(use.inside.text())));
  }
  if (parts->front().source->channel("distance") >= 0) return {std::move(parts), size};
  reader.diagnostics.error(Code::library_missing, reader.where,
                           "meshes are not available: this build has no library for their distances");
  return {};
}

// The contents of a requested file, and of the others that belong to it.
struct MeshFiles {
  std::string_view bytes;
  formats::ResultsBeside beside;  // of grids
  formats::FilesBeside parts;     // of meshes
  Hash content;                   // hash of all
};

MadeParts read_parts(const MeshRequest& request, const MeshFiles& files, const Reader& reader) {
  const std::string& path = request.file.path;
  auto mesh = sources::has_elements(path)
                  ? sources::result_border(path, files.bytes, files.beside, request.deform, reader.diagnostics)
                  : formats::read_mesh(path, files.bytes, reader.diagnostics, files.parts);
  const bool is_plain = request.deform == 0 && request.step == 0;
  const Hash content = is_plain
                           ? files.content
                           : sources::Key("deformed").add(files.content).add(request.deform).add(request.step).hash();
  if (mesh) {
    warn_of_colours(path, *mesh, request.use, reader);
    return parts_of(path, std::move(*mesh), content, request.use, reader);
  }
  reader.diagnostics.note(reader.where, "the file is used here");
  return {};
}

// Returns all solids as one mesh with a group each.
formats::Mesh joined(const std::vector<MadeSolid>& solids) {
  formats::Mesh mesh;
  for (const MadeSolid& solid : solids) {
    if (solid.triangles.empty()) continue;
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    formats::MeshGroup group{solid.part, static_cast<uint32_t>(mesh.triangles.size()),
                             static_cast<uint32_t>(solid.triangles.size())};
    group.material = solid.material;
    group.object = solid.part;
    group.colour = solid.colour;
    mesh.groups.push_back(std::move(group));
    mesh.vertices.insert(mesh.vertices.end(), solid.points.begin(), solid.points.end());
    for (const auto& [a, b, c] : solid.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
  }
  return mesh;
}

Hash content_of(const formats::Mesh& mesh) {
  const auto bytes = [](const auto& list) {
    return std::string_view(reinterpret_cast<const char*>(list.data()), list.size() * sizeof list[0]);
  };
  sources::Key key("solids");
  key.add(bytes(mesh.vertices)).add(bytes(mesh.triangles));
  for (const formats::MeshGroup& group : mesh.groups) {
    key.add(group.name).add(group.material).add(static_cast<double>(group.triangle_count));
    if (group.colour) key.add(bytes(*group.colour));
  }
  return key.hash();
}

}  // namespace

std::shared_ptr<const std::vector<MeshPart>> MeshRequest::load(sources::Loading& loading) {
  if (!loading.find(file)) return nullptr;
  if (cad::is_cad_file(file.path)) {
    loading.reader().diagnostics.error(Code::file_kind, loading.reader().where,
                                       "\"" + file.path + "\" is no mesh but a CAD file", "write cad in place of mesh");
    return nullptr;
  }
  if (deform != 0 && !sources::has_elements(file.path)) {
    loading.reader().diagnostics.error(loading.reader().where,
                                       "\"" + file.path + "\" has no results that could deform it",
                                       "leave deform out, or take a .vtu, .xdmf or .frd file");
    return nullptr;
  }
  if (step != 0 && !sources::has_elements(file.path)) {
    loading.reader().diagnostics.error(loading.reader().where, "\"" + file.path + "\" has no results with steps",
                                       "leave step out, or take an .xdmf, .frd, .pvd or .vtkhdf file");
    return nullptr;
  }
  FilePath numbers{sources::numbers_beside(file.path), {}};
  const bool has_numbers = !numbers.path.empty();
  if (!loading.read_content(file) || (has_numbers && !loading.read_content(numbers))) return nullptr;
  const auto parts = loading.read_beside(file, "parts", formats::files_of_mesh(file.path));
  if (!parts) return nullptr;
  const sources::ResultFiles named = sources::result_files(file, static_cast<uint64_t>(step), loading);
  if (has_numbers) file.content = sources::Key("mesh and numbers").add(file.content).add(numbers.content).hash();
  sources::Key key("mesh");
  key.add(file.content).add(deform).add(step).add(ending_of(file.path)).add(use.inside.text());
  sources::add_use(key, use, loading.reader());
  return loading.cached<Result>(key.hash(), file.path, [&](const Reader& reader) {
    const auto bytes = loading.bytes(file);
    const auto beside = has_numbers ? loading.bytes(numbers) : nullptr;
    MeshFiles files{*bytes, {{}, named.files(), static_cast<uint64_t>(step)}, *parts, file.content};
    if (beside) files.beside.values = formats::ResultsFile{numbers.path, *beside};
    return read_parts(*this, files, reader);
  });
}

std::shared_ptr<const std::vector<MeshPart>> SolidsRequest::load(sources::Loading& loading) {
  const Reader& reader = loading.reader();
  formats::Mesh mesh = joined(*solids);
  if (mesh.triangles.empty()) {
    reader.diagnostics.error(Code::file_content, reader.where, '"' + name + "\" gives no solids", {}, {{"file", name}});
    return nullptr;
  }
  const Hash content = content_of(mesh);
  sources::Key key("made solids");
  key.add(content).add(use.inside.text());
  sources::add_use(key, use, reader);
  return loading.cached<Result>(key.hash(), name,
                                [&](const Reader& own) { return parts_of(name, std::move(mesh), content, use, own); });
}

}  // namespace ombre::design
