#include "export/image_stack.h"

#include <algorithm>

namespace ombre::exporting {
namespace {

using voxel::Colour;
using voxel::Raster;

// Returns the layer with all other materials replaced by void.
RunLayer only(const RunLayer& layer, MaterialId material) {
  RunLayer result(layer.width());
  std::vector<MaterialId> row(layer.width());
  for (uint32_t j = 0; j < layer.height(); ++j) {
    layer.row(j).unpack(row.data());
    for (MaterialId& voxel : row) voxel = voxel == material ? material : MaterialId{0};
    result.append_row(row.data());
  }
  return result;
}

formats::Palette palette(const ImageStack& stack) {
  formats::Palette palette(shown(stack.background, stack.format));
  for (const StackMaterial& material : stack.materials) palette.add(material.id, shown(material.colour, stack.format));
  return palette;
}

formats::DotsPerMetre resolution(const ImageStack& stack) {
  return {stack.pitch_x.dots_per_metre(), stack.pitch_y.dots_per_metre()};
}

formats::PngLayout layout_of(const ImageStack& stack) {
  const formats::DotsPerMetre dots = resolution(stack);
  return {stack, dots.x, dots.y};
}

std::vector<std::string> encode_materials(const RunLayer& layer, const ImageStack& stack) {
  const formats::Palette colours = palette(stack);
  formats::PngLayout layout = layout_of(stack);
  if (!stack.files.has_material()) return {formats::encode_png(layer, colours, layout)};
  std::vector<std::string> images;
  for (const StackMaterial& material : stack.materials) {
    layout.mask_of = material.id;
    const bool is_mask = stack.format == ImageFormat::mask;
    images.push_back(formats::encode_png(is_mask ? layer : only(layer, material.id), colours, layout));
  }
  return images;
}

// Returns the pixels as an image has them, with rows from the top.
template <class T>
std::vector<T> image_pixels(const Raster<T>& raster, const ImageLayout& layout) {
  std::vector<T> pixels;
  pixels.reserve(raster.values.size());
  for (uint32_t i = 0; i < raster.height(); ++i) {
    const uint32_t j = layout.flip_y ? i : raster.height() - 1 - i;
    const T* row = raster.values.data() + size_t{j} * raster.width;
    pixels.insert(pixels.end(), row, row + raster.width);
    if (layout.flip_x) std::reverse(pixels.end() - raster.width, pixels.end());
  }
  return pixels;
}

struct PixelEncoder {
  const ImageStack& stack;
  int bits;

  std::string operator()(const RunLayer& shades) const {
    return formats::encode_shades_png(shades, bits, layout_of(stack));
  }
  std::string operator()(const Raster<uint16_t>& shades) const {
    return formats::encode_gray_png(shades.width, shades.height(), image_pixels(shades, stack), resolution(stack));
  }
  std::string operator()(const Raster<Colour>& colours) const {
    return formats::encode_rgba_png(colours.width, colours.height(), image_pixels(colours, stack), resolution(stack));
  }
};

}  // namespace

std::vector<std::string> ImageStack::encode(const voxel::ChannelPixels& pixels, voxel::ChannelType type) const {
  if (type == voxel::ChannelType::material) return encode_materials(std::get<RunLayer>(pixels), *this);
  return {std::visit(PixelEncoder{*this, voxel::channel_kind(type).bits}, pixels)};
}

formats::Rgba shown(formats::Rgba colour, ImageFormat format) {
  if (format != ImageFormat::gray) return colour;
  const int thousandths = 299 * colour[0] + 587 * colour[1] + 114 * colour[2];
  const auto gray = static_cast<uint8_t>((thousandths + 500) / 1000);
  return {gray, gray, gray, 255};
}

}  // namespace ombre::exporting
