// Loads images as pixels, and colours of surfaces, for designs.
#include <algorithm>
#include <filesystem>

#include "base/text/error.h"
#include "base/text/file_ending.h"
#include "formats/images/read_picture.h"
#include "formats/mesh/mtl.h"
#include "formats/packages/read_mesh.h"
#include "import/fields/surface_colours.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

void add_places(formats::Mesh& mesh) {
  for (size_t n = 0; n < mesh.shadings.size(); ++n) {
    mesh.shadings[n].image = 0;
    for (size_t corner = 0; corner < 3; ++corner)
      mesh.shadings[n].places[corner] = mesh.texture_coordinates[mesh.texture_triangles[n][corner]];
  }
}

void add_vertex_colours(formats::Mesh& mesh) {
  for (size_t n = 0; n < mesh.shadings.size(); ++n)
    for (size_t corner = 0; corner < 3; ++corner)
      mesh.shadings[n].colours[corner] = mesh.vertex_colours[mesh.triangles[n][corner]];
}

// Returns false if no group has a colour; those without one are white.
bool add_group_colours(formats::Mesh& mesh) {
  bool has_some = false;
  for (const formats::MeshGroup& group : mesh.groups) {
    if (!group.colour) continue;
    has_some = true;
    for (uint32_t n = 0; n < group.triangle_count; ++n)
      mesh.shadings[group.first_triangle + n].colours.fill(formats::shares_of(*group.colour));
  }
  return has_some;
}

// Gives each triangle of a mesh a shading, if its file has none for them: by an image that the design names, or colours
// of vertices or groups. Throws Error if there are no such.
void add_shadings(const std::string& path, bool has_image, formats::Mesh& mesh) {
  if (has_image && mesh.texture_triangles.empty())
    throw Error(
        Code::file_content,
        "the mesh \"" + path + "\" has no texture coordinates for an image; leave texture out, or save it with them",
        {{"file", path}});
  if (!has_image && !mesh.shadings.empty()) return;
  mesh.shadings.assign(mesh.triangles.size(), {});
  if (has_image) return add_places(mesh);
  if (!mesh.vertex_colours.empty()) return add_vertex_colours(mesh);
  if (add_group_colours(mesh)) return;
  throw Error(Code::file_content,
              "the vertices of the mesh \"" + path +
                  "\" have no colours; name the image of its texture with texture=\"image.png\", or save it as PLY or "
                  "OBJ with colours",
              {{"file", path}});
}

// The materials of an OBJ file, and the images beside a mesh file.
struct MaterialFiles {
  std::vector<formats::ObjMaterial> materials;
  std::vector<FilePath> images;  // of OBJ's materials, in their order; without a path: none
};

// Reads the materials that an OBJ file names. Files of materials that are missing are left out with a warning, and
// images that are missing are an error. Returns nothing, with diagnostics, if one is wrong.
std::optional<MaterialFiles> material_files(const FilePath& file, std::string_view obj, sources::Loading& loading,
                                            sources::Key& key) {
  MaterialFiles found;
  for (const std::string& name : formats::material_libraries(obj)) {
    FilePath library = sources::beside(file, name);
    if (!std::filesystem::exists(library.path)) {
      loading.reader().diagnostics.warning(
          loading.reader().where,
          "the mesh \"" + file.path + "\" names the materials \"" + name + "\", which do not lie beside it");
      continue;
    }
    if (!loading.read_content(library)) return std::nullopt;
    key.add(library.content);
    const auto read = formats::read_mtl(library.path, *loading.bytes(library), loading.reader().diagnostics);
    if (!read) return std::nullopt;
    for (const formats::ObjMaterial& material : *read) {
      FilePath image;
      if (!material.image.name.empty()) {
        image = sources::beside(library, material.image.name);
        if (!loading.read_content(image)) return std::nullopt;
        key.add(image.content);
      }
      found.materials.push_back(material);
      found.images.push_back(image);
    }
  }
  return found;
}

// Reads the images that a glTF file names. Returns nothing, with a diagnostic, if one cannot be read.
std::optional<MaterialFiles> image_files(const FilePath& file, sources::Loading& loading, sources::Key& key) {
  MaterialFiles found;
  if (!formats::files_of_mesh(file.path)) return found;
  FilePath whole = file;
  const auto images = loading.read_beside(whole, "images", formats::gltf_image_files);
  if (!images) return std::nullopt;
  key.add(whole.content);
  for (const auto& [name, bytes] : *images) found.images.push_back(sources::beside(file, name));
  return found;
}

importing::SurfaceImage surface_image(const std::string& bytes, const std::string& name,
                                      const formats::MeshImage& how) {
  formats::Picture read = formats::read_picture(name, bytes, formats::Turning::as_stored);
  return {read.width, read.height, std::move(read.rgba), how.wrap_u, how.wrap_v};
}

}  // namespace

std::shared_ptr<const program::FieldSource> SurfaceColoursRequest::load(sources::Loading& loading) {
  using Made = sources::Loading::Made<Result>;
  const bool has_image = !image.path.empty();
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  if (has_image && (!loading.find(image) || !loading.read_content(image))) return nullptr;
  const auto parts = loading.read_beside(file, "parts", formats::files_of_mesh(file.path));
  if (!parts) return nullptr;
  sources::Key key("surface colours");
  key.add(file.content).add(has_image ? image.content.hex() : "");
  std::optional<MaterialFiles> beside_it = MaterialFiles();
  if (!has_image && ending_of(file.path) == ".obj")
    beside_it = material_files(file, *loading.bytes(file), loading, key);
  else if (!has_image)
    beside_it = image_files(file, loading, key);
  if (!beside_it) return nullptr;
  return loading.cached<Result>(key.hash(), file.path, [&](const Reader& reader) {
    auto mesh = formats::read_mesh(file.path, *loading.bytes(file), reader.diagnostics, *parts);
    if (!mesh) return Made{};
    for (formats::MeshImage& one : mesh->images)
      if (one.bytes.empty()) one.name = sources::beside(file, one.name).path;
    std::vector<importing::SurfaceImage> images;
    if (has_image) {
      images.push_back(surface_image(*loading.bytes(image), image.path, {}));
    } else if (!beside_it->materials.empty() && mesh->vertex_colours.empty()) {
      for (size_t n = 0; n < beside_it->materials.size(); ++n)
        beside_it->materials[n].image.name = beside_it->images[n].path;
      formats::apply_materials(file.path, beside_it->materials, *mesh, reader.diagnostics);
    }
    add_shadings(file.path, has_image, *mesh);
    for (const formats::MeshImage& one : mesh->images) {
      if (has_image) break;
      const auto of = std::ranges::find(beside_it->images, one.name, &FilePath::path);
      const bool is_inside = !one.bytes.empty() || of == beside_it->images.end();
      images.push_back(surface_image(is_inside ? one.bytes : *loading.bytes(*of), one.name, one));
    }
    size_t bytes = sizeof(formats::TriangleShading) * mesh->triangles.size();
    constexpr size_t bytes_of_triangle = 200;
    bytes += bytes_of_triangle * mesh->triangles.size();
    for (const importing::SurfaceImage& one : images) bytes += one.rgba.size();
    return Made{importing::make_surface_colours(file.path, std::move(*mesh), std::move(images), key.hash()), bytes};
  });
}

std::shared_ptr<const ImagePixels> PixelsRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  using Made = sources::Loading::Made<ImagePixels>;
  return loading.cached<ImagePixels>(sources::Key("pixels").add(file.content).hash(), file.path, [&](const Reader&) {
    formats::Picture read = formats::read_picture(file.path, *loading.bytes(file), formats::Turning::as_seen);
    const size_t bytes = read.rgba.size();
    return Made{std::make_shared<ImagePixels>(ImagePixels{read.width, read.height, std::move(read.rgba)}), bytes};
  });
}

}  // namespace ombre::design
