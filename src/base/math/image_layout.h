// How an image shows a layer of voxels.
#pragma once

namespace ombre {

// rgba and indexed have the materials' colours, gray the luminance of these. mask is white where one material is, black
// elsewhere. Indexed images have as much of the palette as fits into the fewest bits that hold the layer.
enum class ImageFormat { rgba, indexed, gray, mask };

// Unflipped, x grows to the right and image row 0 has the greatest y.
struct ImageLayout {
  ImageFormat format = ImageFormat::indexed;
  bool flip_x = false, flip_y = false;
};

}  // namespace ombre
