// Layers of voxels as a stack of PNG files, by a printer's conventions.
#pragma once

#include <string>

#include "base/pitch.h"
#include "base/run.h"
#include "formats/png.h"

namespace ombre::exporting {

// Everything that decides the bytes of a layer's file.
struct PngStack {
  formats::Palette palette;  // void and every material of the job
  formats::PngFormat format = formats::PngFormat::indexed;
  Pitch pitch_x, pitch_y;
  bool flip_x = false, flip_y = false;
  MaterialId mask_of = 0;  // of masks

  // Throws Error when memory runs out.
  std::string encode(const RunLayer& layer) const;
};

}  // namespace ombre::exporting
