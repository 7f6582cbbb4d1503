// The format and orientation of images of voxel layers.
#pragma once

namespace ombre {

// The pixel values of an image. rgba and indexed: the materials' colours. gray: the luminance of these colours. mask:
// white for one material, black elsewhere. Indexed images use the fewest bits per pixel that hold the materials of the
// layer, and store as much of the palette as fits.
enum class ImageFormat { rgba, indexed, gray, mask };

// Orientation of an image. If not flipped, x grows to the right and image row 0 has the greatest y.
struct ImageLayout {
  ImageFormat format = ImageFormat::indexed;
  bool flip_x = false, flip_y = false;
};

}  // namespace ombre
