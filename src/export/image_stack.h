// Encodes the images of a layer: one of each channel, or one of each material.
#pragma once

#include <string>
#include <vector>

#include "base/math/pitch.h"
#include "base/math/run.h"
#include "formats/images/png.h"
#include "voxel/channel.h"
#include "voxel/printer.h"

namespace ombre::exporting {

struct StackMaterial {
  MaterialId id = 1;
  formats::Rgba colour{};
};

// All settings that determine the bytes of a layer's files.
struct ImageStack : voxel::Images {
  std::vector<StackMaterial> materials;  // the job's materials, without void
  Pitch pitch_x, pitch_y;

  // Returns the PNG files of a channel, whose type the format takes: one, or of materials one for each in their order,
  // in which the others are void. Throws Error if memory runs out.
  std::vector<std::string> encode(const voxel::ChannelPixels& pixels, voxel::ChannelType type) const;
};

// Returns the colour that an image of this format shows for a colour: with `gray` its luma, 0.299 r + 0.587 g + 0.114 b
// (ITU-R BT.601), else the colour itself.
formats::Rgba shown(formats::Rgba colour, ImageFormat format);

// The colour of void in masks.
inline constexpr formats::Rgba mask_off{0, 0, 0, 255};

}  // namespace ombre::exporting
