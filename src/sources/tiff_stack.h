// The pages of a TIFF file that hold the slices of one volume.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/volumes/volume.h"
#include "tiff/pages.h"

namespace ombre::sources {

struct ChosenPages {
  std::vector<size_t> pages;  // one for each slice, from the lowest
  int channel = -1;           // of the values of a pixel; -1 if none is chosen
  std::optional<Vec3> spacing_mm;
  std::vector<std::string> warnings;
};

// Chooses the pages of one channel and one frame, as ImageJ or OME describe them; without a description every page is a
// slice. Throws Error, naming the path, if there are several and none is chosen, or if pages are missing.
ChosenPages chosen_pages(const std::string& path, const tiff::Document& document, const formats::VolumeChoice& choice);

}  // namespace ombre::sources
