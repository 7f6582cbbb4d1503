// Draws layers in a grid as one picture, in true proportions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "export/picture_file.h"

namespace ombre::exporting {

struct SheetImage {
  std::string file;                  // path of a PNG file
  std::optional<formats::Rgba> ink;  // colour for all pixels other than background; if not set, they keep their own
};

struct SheetLayer {
  std::vector<SheetImage> images;  // at least one; the others are laid over the first
  int64_t layer = 0;               // number and height of the layer, for the label
  double z_mm = 0;
};

struct SheetStyle {
  double pixel_width_mm = 0.1, pixel_height_mm = 0.1;  // size of the layers' pixels, which need not be square
  formats::Rgba background{};                          // colour of void in the layers
};

// Returns a picture at most 1600 pixels wide. All layers are cropped to the area where any of them has material. They
// are read one at a time. Throws Error for a file that is not an image or differs in size from the first.
Picture draw_contact_sheet(const std::vector<SheetLayer>& layers, const SheetStyle& style);

}  // namespace ombre::exporting
