// The images of a layer: one of all materials, or one of each.
#pragma once

#include <string>
#include <vector>

#include "base/pitch.h"
#include "base/run.h"
#include "formats/png.h"
#include "voxel/printer.h"

namespace ombre::exporting {

struct StackMaterial {
  MaterialId id = 1;
  formats::Rgba colour{};
};

// Everything that decides the bytes of a layer's files.
struct MaterialStack {
  std::vector<StackMaterial> materials;  // those of the job, without void
  formats::Rgba background{};            // void's colour
  voxel::ImageFormat format = voxel::ImageFormat::indexed;
  bool one_for_each = false;  // an image for each material, in which the others are void
  Pitch pitch_x, pitch_y;
  bool flip_x = false, flip_y = false;

  // One PNG file, or one for each material, in their order. Throws Error when memory runs out.
  std::vector<std::string> encode(const RunLayer& layer) const;
  // One PNG file in 65,536 shades of gray.
  std::string encode_shades(const RunLayer& upper_bytes, const RunLayer& lower_bytes) const;
};

// What an image of this format shows for a colour: with `gray` its brightness, 0.299 r + 0.587 g + 0.114 b
// (ITU-R BT.601), else the colour itself.
formats::Rgba shown(formats::Rgba colour, voxel::ImageFormat format);

// What is void in masks.
inline constexpr formats::Rgba mask_off{0, 0, 0, 255};

}  // namespace ombre::exporting
