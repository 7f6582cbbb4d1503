// Loads images as pixels, and colours of surfaces, for designs.
#include "base/text/error.h"
#include "formats/images/png.h"
#include "formats/packages/read_mesh.h"
#include "import/fields/surface_colours.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

constexpr uint64_t most_texture_pixels = uint64_t{1} << 27;  // 0.5 GB

ImagePixels pixels_of(const formats::PngImage& png) {
  ImagePixels pixels{png.width, png.height, {}};
  pixels.rgba.reserve(4 * pixels.columns * pixels.rows);
  for (uint32_t row = 0; row < png.height; ++row)
    for (uint32_t column = 0; column < png.width; ++column) {
      const formats::Rgba colour = png.colour(column, row);
      pixels.rgba.insert(pixels.rgba.end(), colour.begin(), colour.end());
    }
  return pixels;
}

// Returns the mesh of a file. Throws Error if it lacks colours for the image, or of its own.
formats::Mesh coloured_mesh(const std::string& path, formats::Mesh mesh, bool has_image) {
  if (has_image && mesh.texture_triangles.empty())
    throw Error(
        Code::file_content,
        "the mesh \"" + path + "\" has no texture coordinates for an image; leave texture out, or save it with them",
        {{"file", path}});
  if (!has_image && mesh.vertex_colours.empty())
    throw Error(
        Code::file_content,
        "the vertices of the mesh \"" + path +
            "\" have no colours; name the image of its texture with texture=\"image.png\", or save it as PLY or "
            "OBJ with colours",
        {{"file", path}});
  return mesh;
}

}  // namespace

std::shared_ptr<const program::FieldSource> SurfaceColoursRequest::load(sources::Loading& loading) {
  using Made = sources::Loading::Made<Result>;
  const bool has_image = !image.path.empty();
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  if (has_image && (!loading.find(image) || !loading.read_content(image))) return nullptr;
  sources::Key key("surface colours");
  key.add(file.content).add(has_image ? image.content.hex() : "");
  return loading.cached<Result>(key.hash(), file.path, [&](const Reader& reader) {
    auto mesh = formats::read_mesh(file.path, *loading.bytes(file), reader.diagnostics);
    if (!mesh) return Made{};
    importing::SurfaceImage pixels;
    if (has_image) {
      ImagePixels read = pixels_of(formats::decode_png(*loading.bytes(image), image.path, most_texture_pixels));
      pixels = {read.columns, read.rows, std::move(read.rgba)};
    }
    constexpr size_t bytes_of_triangle = 200;
    const size_t bytes = bytes_of_triangle * mesh->triangles.size() + pixels.rgba.size();
    return Made{importing::make_surface_colours(file.path, coloured_mesh(file.path, std::move(*mesh), has_image),
                                                std::move(pixels), key.hash()),
                bytes};
  });
}

std::shared_ptr<const ImagePixels> PixelsRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  using Made = sources::Loading::Made<ImagePixels>;
  return loading.cached<ImagePixels>(sources::Key("pixels").add(file.content).hash(), file.path, [&](const Reader&) {
    auto pixels = std::make_shared<ImagePixels>(
        pixels_of(formats::decode_png(*loading.bytes(file), file.path, most_texture_pixels)));
    const size_t bytes = pixels->rgba.size();
    return Made{std::move(pixels), bytes};
  });
}

}  // namespace ombre::design
