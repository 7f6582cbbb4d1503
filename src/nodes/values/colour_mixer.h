// Mixtures of materials that show a colour.
//
// Small droplets side by side look like the mean of their light, so what materials can show together is the convex hull
// of their colours in linear light. Of the mixtures that show a colour, the one is taken in which brightness varies
// least from droplet to droplet (D. Shaked, N. Arad, A. Fitzhugh and I. Sobel, "Color Diffusion: Error-Diffusion for
// Color Halftones", HP Laboratories 1996). Colours beyond the hull give way to the nearest of the hull, in linear
// light.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "program/field_source.h"

namespace ombre::nodes {

class ColourMixer {
 public:
  static constexpr size_t most_materials = 12;

  // Red, green and blue in linear light, 0 to 1, of 1 to `most_materials` materials.
  explicit ColourMixer(std::vector<Vec3> colours);

  // A share for each material, together 1, for a colour in linear light.
  std::vector<double> shares(Vec3 colour) const;

 private:
  // One to four materials, whose colours lie on no point, line or plane of fewer. Where `origin` is the first's colour,
  // the shares of the others are the products of `slopes` with what is left of a colour.
  struct Group {
    std::vector<size_t> members;
    std::vector<Vec3> slopes;
  };
  void add_groups(std::vector<size_t> members, size_t next);

  std::vector<Vec3> colours_;
  std::vector<Group> groups_;
};

// The mixer's shares over sRGB colours from 0 to 1: the channels "0", "1", ... of a table with 33 colours each way, and
// straight between them.
program::SourceField make_colour_table(const ColourMixer& mixer, size_t materials);

}  // namespace ombre::nodes
