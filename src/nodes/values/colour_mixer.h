// Mixtures of materials that show a given colour.
//
// Small droplets side by side look like the mean of their light. The colours that materials can show together are
// therefore the convex hull of their colours in linear light. Of the mixtures with a given colour, the one with the
// least variation of brightness between droplets is chosen (D. Shaked, N. Arad, A. Fitzhugh and I. Sobel, "Color
// Diffusion: Error-Diffusion for Color Halftones", HP Laboratories 1996). Colours outside the hull are replaced by its
// nearest colour in linear light.
#pragma once

#include <vector>

#include "base/math/vec.h"
#include "program/field_source.h"

namespace ombre::nodes {

class ColourMixer {
 public:
  static constexpr size_t most_materials = 12;

  // `colours` are red, green and blue in linear light, 0 to 1, of 1 to `most_materials` materials.
  explicit ColourMixer(std::vector<Vec3> colours);

  // Returns a share for each material, with a sum of 1, for a colour in linear light.
  std::vector<double> shares(Vec3 colour) const;

 private:
  // One to four materials whose colours are affinely independent. Relative to the first one's colour, the shares of the
  // others are the products of `slopes` with a colour.
  struct Group {
    std::vector<size_t> members;
    std::vector<Vec3> slopes;
  };
  void add_groups(std::vector<size_t> members, size_t next);

  std::vector<Vec3> colours_;
  std::vector<Group> groups_;
};

// Returns a table of the mixer's shares over sRGB colours from 0 to 1, with the channels "0", "1", ... It has 33
// colours along each axis, with linear interpolation between them.
program::SourceField make_colour_table(const ColourMixer& mixer, size_t materials);

}  // namespace ombre::nodes
