// Encodes the images of a layer: one of all materials, or one per material.
#include "export/material_stack.h"

namespace ombre::exporting {
namespace {

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

formats::Palette palette(const MaterialStack& stack) {
  formats::Palette palette(shown(stack.background, stack.format));
  for (const StackMaterial& material : stack.materials) palette.add(material.id, shown(material.colour, stack.format));
  return palette;
}

formats::PngLayout layout_of(const MaterialStack& stack) {
  formats::PngLayout layout{stack};
  layout.dots_per_metre_x = stack.pitch_x.dots_per_metre();
  layout.dots_per_metre_y = stack.pitch_y.dots_per_metre();
  return layout;
}

}  // namespace

std::vector<std::string> MaterialStack::encode(const RunLayer& layer) const {
  const formats::Palette colours = palette(*this);
  formats::PngLayout layout = layout_of(*this);
  if (!files.has_material()) return {formats::encode_png(layer, colours, layout)};
  std::vector<std::string> images;
  for (const StackMaterial& material : materials) {
    layout.mask_of = material.id;
    images.push_back(
        formats::encode_png(format == ImageFormat::mask ? layer : only(layer, material.id), colours, layout));
  }
  return images;
}

std::string MaterialStack::encode_shades(const RunLayer& upper_bytes, const RunLayer& lower_bytes) const {
  const uint32_t width = upper_bytes.width(), height = upper_bytes.height();
  std::vector<uint16_t> pixels;
  pixels.reserve(size_t{width} * height);
  std::vector<MaterialId> upper(width), lower(width);
  for (uint32_t i = 0; i < height; ++i) {
    const uint32_t j = flip_y ? i : height - 1 - i;
    upper_bytes.row(j).unpack(upper.data());
    lower_bytes.row(j).unpack(lower.data());
    for (uint32_t n = 0; n < width; ++n) {
      const uint32_t at = flip_x ? width - 1 - n : n;
      pixels.push_back(static_cast<uint16_t>(upper[at] << 8 | lower[at]));
    }
  }
  return formats::encode_gray_png(width, height, pixels, {pitch_x.dots_per_metre(), pitch_y.dots_per_metre()});
}

formats::Rgba shown(formats::Rgba colour, ImageFormat format) {
  if (format != ImageFormat::gray) return colour;
  const int thousandths = 299 * colour[0] + 587 * colour[1] + 114 * colour[2];
  const auto gray = static_cast<uint8_t>((thousandths + 500) / 1000);
  return {gray, gray, gray, 255};
}

}  // namespace ombre::exporting
