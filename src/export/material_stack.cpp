// The images of a layer: one of all materials, or one of each.
#include "export/material_stack.h"

#include "export/png_stack.h"

namespace ombre::exporting {
namespace {

using voxel::ImageFormat;

// The layer with all but one material taken for void.
RunLayer only(const RunLayer& layer, MaterialId material) {
  RunLayer result;
  result.width = layer.width;
  result.rows.resize(layer.rows.size());
  for (size_t j = 0; j < layer.rows.size(); ++j)
    for (const Run& run : layer.rows[j])
      append_run(result.rows[j], run.material == material ? material : MaterialId{0}, run.length);
  return result;
}

formats::Palette palette(const MaterialStack& stack) {
  formats::Palette palette(shown(stack.background, stack.format));
  for (const StackMaterial& material : stack.materials) palette.add(material.id, shown(material.colour, stack.format));
  return palette;
}

formats::Palette mask_palette(MaterialId material) {
  formats::Palette palette(mask_off);
  palette.add(material, mask_on);
  return palette;
}

PngStack png_stack(const MaterialStack& stack, formats::Palette palette) {
  PngStack png;
  png.palette = std::move(palette);
  // Grey and black and white go through a palette of these.
  png.format = stack.format == ImageFormat::rgba ? formats::PngFormat::rgba : formats::PngFormat::indexed;
  png.pitch_x = stack.pitch_x;
  png.pitch_y = stack.pitch_y;
  png.flip_x = stack.flip_x;
  png.flip_y = stack.flip_y;
  return png;
}

}  // namespace

std::vector<std::string> MaterialStack::encode(const RunLayer& layer) const {
  if (!one_for_each) return {png_stack(*this, palette(*this)).encode(layer)};
  std::vector<std::string> files;
  for (const StackMaterial& material : materials) {
    const bool is_mask = format == ImageFormat::mask;
    const PngStack png = png_stack(*this, is_mask ? mask_palette(material.id) : palette(*this));
    files.push_back(png.encode(only(layer, material.id)));
  }
  return files;
}

formats::Rgba shown(formats::Rgba colour, ImageFormat format) {
  if (format != ImageFormat::gray) return colour;
  const int thousandths = 299 * colour[0] + 587 * colour[1] + 114 * colour[2];
  const auto gray = static_cast<uint8_t>((thousandths + 500) / 1000);
  return {gray, gray, gray, 255};
}

}  // namespace ombre::exporting
