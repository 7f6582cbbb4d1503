#include "compile/image_loader.h"

#include "base/error.h"
#include "compile/find_file.h"
#include "formats/file.h"
#include "formats/png.h"
#include "import/height_source.h"

namespace ombre::compile {
namespace {

constexpr uint64_t most_pixels = uint64_t{1} << 27;  // a gigabyte and a half while it is read

// As bright as it looks over black, from 0 to 1: the luma of ITU-R BT.601.
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

design::HeightImage load_heights(design::FilePath& path, const design::Reader& reader) {
  const auto found = find_file(path.path, reader.where, reader.diagnostics);
  if (!found) return {};
  try {
    const std::string bytes = formats::read_file(*found);
    importing::GrayImage image = gray_of(formats::decode_png(bytes, *found, most_pixels));
    const auto [across, up] = importing::steepest_steps(image);
    path.path = *found;
    path.content = hash_bytes(bytes);
    design::HeightImage heights{nullptr, static_cast<double>(image.width), static_cast<double>(image.height), across,
                                up};
    heights.source = importing::make_height_source(*found, std::move(image), path.content);
    return heights;
  } catch (const Error& error) {
    reader.diagnostics.error(reader.where, error.what());
    return {};
  }
}

}  // namespace ombre::compile
