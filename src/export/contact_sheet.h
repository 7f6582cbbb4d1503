// A grid of layers as one picture, in true proportions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "export/picture_file.h"

namespace ombre::exporting {

struct SheetImage {
  std::string file;                  // path of its PNG
  std::optional<formats::Rgba> ink;  // drawn in place of what is not background; else its own colours
};

struct SheetLayer {
  std::vector<SheetImage> images;  // at least one; those after the first are laid over it
  int64_t layer = 0;               // its number and height, for the label
  double z_mm = 0;
};

struct SheetStyle {
  double pixel_width_mm = 0.1, pixel_height_mm = 0.1;  // of the layers' pixels, which need not be square
  formats::Rgba background{};                          // the colour of void in the layers
};

// At most 1600 pixels wide. Layers are cropped, all alike, to where any of them has material. They
// are read one at a time. Throws Error for a file that is no image or has another size than the first.
Picture draw_contact_sheet(const std::vector<SheetLayer>& layers, const SheetStyle& style);

}  // namespace ombre::exporting
