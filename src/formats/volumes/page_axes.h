// How the pages of a TIFF file lie along the axes of a grid: ImageJ and OME say so in the description of the first
// page.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec.h"

namespace ombre::formats {

// The axis along which each page follows the one before.
enum class PageAxis : uint8_t { slices, channels, frames };

struct PageAxes {
  int64_t slices = 1, channels = 1, frames = 1;
  // The order of the axes, the fastest first.
  std::array<PageAxis, 3> order{PageAxis::channels, PageAxis::slices, PageAxis::frames};
  std::vector<std::string> channel_names;  // may be empty
  // Lengths of a voxel in mm where the description gives them.
  std::optional<double> x_mm, y_mm, z_mm;
  // Factor from the unit of the description to mm, which is also that of the pages' resolution; none if it has no unit.
  std::optional<double> unit_mm;
  bool is_imagej = false;
  // OME: which page holds which slice, where that does not follow from the order.
  std::vector<int64_t> pages;  // page for each plane in the order of the axes; empty if they follow each other
  std::vector<std::string> warnings;

  int64_t count() const { return slices * channels * frames; }
  // Returns the number of a plane in the order of the axes.
  int64_t plane(int64_t slice, int64_t channel, int64_t frame) const;
};

// Reads a description. Returns nothing for a text of another kind. Throws Error, naming the path, if the text is
// damaged, or says something about the planes that is not read.
std::optional<PageAxes> page_axes(const std::string& path, const std::string& description);

}  // namespace ombre::formats
