// Loads images as heights for designs.
#include "formats/images/read_picture.h"
#include "import/fields/height_source.h"
#include "sources/loading.h"

namespace ombre::design {
namespace {

// Returns the luma (ITU-R BT.601) of a colour over black, from 0 to 1.
float brightness(const uint8_t* rgba) {
  const double luma = 0.299 * rgba[0] + 0.587 * rgba[1] + 0.114 * rgba[2];
  return static_cast<float>(luma / 255 * rgba[3] / 255);
}

importing::GrayImage gray_of(const formats::Picture& picture) {
  importing::GrayImage image{picture.width, picture.height, {}};
  image.values.reserve(size_t{picture.width} * picture.height);
  for (size_t at = 0; at < picture.rgba.size(); at += 4) image.values.push_back(brightness(&picture.rgba[at]));
  return image;
}

}  // namespace

std::shared_ptr<const HeightImage> ImageRequest::load(sources::Loading& loading) {
  if (!loading.find(file) || !loading.read_content(file)) return nullptr;
  using Made = sources::Loading::Made<HeightImage>;
  constexpr size_t bytes_per_pixel = 4 * sizeof(float);  // for its value and the extremes around it
  return loading.cached<HeightImage>(sources::Key("image").add(file.content).hash(), file.path, [&](const Reader&) {
    importing::GrayImage image =
        gray_of(formats::read_picture(file.path, *loading.bytes(file), formats::Turning::as_seen));
    const auto [across, up] = importing::steepest_steps(image);
    const size_t bytes = bytes_per_pixel * image.values.size();
    auto heights = std::make_shared<HeightImage>(
        HeightImage{nullptr, static_cast<double>(image.width), static_cast<double>(image.height), across, up});
    heights->source = importing::make_height_source(file.path, std::move(image), file.content);
    return Made{std::move(heights), bytes};
  });
}

}  // namespace ombre::design
