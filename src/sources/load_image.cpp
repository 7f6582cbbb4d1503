// Loads images as heights for designs.
#include "formats/images/png.h"
#include "import/fields/height_source.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

constexpr uint64_t most_pixels = uint64_t{1} << 27;  // about 1.5 GB while the image is read

// Returns the luma (ITU-R BT.601) of a colour over black, from 0 to 1.
float brightness(formats::Rgba colour) {
  const double luma = 0.299 * colour[0] + 0.587 * colour[1] + 0.114 * colour[2];
  return static_cast<float>(luma / 255 * colour[3] / 255);
}

importing::GrayImage gray_of(const formats::PngImage& png) {
  importing::GrayImage image{png.width, png.height, {}};
  image.values.reserve(size_t{png.width} * png.height);
  for (uint32_t row = 0; row < png.height; ++row)
    for (uint32_t column = 0; column < png.width; ++column) image.values.push_back(brightness(png.colour(column, row)));
  return image;
}

}  // namespace

std::shared_ptr<const HeightImage> ImageRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  using Made = sources::Loading::Made<HeightImage>;
  constexpr size_t bytes_per_pixel = 4 * sizeof(float);  // for its value and the extremes around it
  return loading.cached<HeightImage>(sources::Key("image").add(file.content).hash(), file.path, [&](const Reader&) {
    importing::GrayImage image = gray_of(formats::decode_png(*loading.bytes(file), file.path, most_pixels));
    const auto [across, up] = importing::steepest_steps(image);
    const size_t bytes = bytes_per_pixel * image.values.size();
    auto heights = std::make_shared<HeightImage>(
        HeightImage{nullptr, static_cast<double>(image.width), static_cast<double>(image.height), across, up});
    heights->source = importing::make_height_source(file.path, std::move(image), file.content);
    return Made{std::move(heights), bytes};
  });
}

}  // namespace ombre::design
