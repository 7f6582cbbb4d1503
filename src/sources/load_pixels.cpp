// Loads images as pixels for designs.
#include "formats/images/png.h"
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

}  // namespace

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
