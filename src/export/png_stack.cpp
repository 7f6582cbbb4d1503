// Layers of voxels as a stack of PNG files, by a printer's conventions.
#include "export/png_stack.h"

namespace ombre::exporting {

std::string PngStack::encode(const RunLayer& layer) const {
  formats::PngLayout layout;
  layout.format = format;
  layout.dots_per_metre_x = pitch_x.dots_per_metre();
  layout.dots_per_metre_y = pitch_y.dots_per_metre();
  layout.flip_x = flip_x;
  layout.flip_y = flip_y;
  layout.mask_of = mask_of;
  return formats::encode_png(layer, palette, layout);
}

}  // namespace ombre::exporting
