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

namespace ombre::ink {

class ColourMixer {
 public:
  static constexpr size_t most_materials = 12;

  // `colours` are red, green and blue in linear light, 0 to 1, of 1 to `most_materials` materials. They may be numbers
  // of another space in which the numbers of a mixture are the mean of those of its materials; `weights` are then the
  // contributions of the three numbers to brightness.
  explicit ColourMixer(std::vector<Vec3> colours, const Vec3& weights = {0.2126, 0.7152, 0.0722});

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
  Vec3 weights_;
  std::vector<Group> groups_;
};

}  // namespace ombre::ink
