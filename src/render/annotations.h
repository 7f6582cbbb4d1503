// Axes, a scale bar and a legend beside the contents of a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "draw/pen.h"
#include "render/camera.h"
#include "render/shade.h"

namespace ombre::render {

struct Swatch {
  std::string name;
  Rgba8 colour{};
};

// A bar of colours for numbers, with the greatest at the top.
struct ColourBar {
  struct Tick {
    double share = 0;  // position on the bar, from 0 at the bottom to 1 at the top
    std::string text;
  };
  std::string title;
  std::vector<Rgba8> colours;  // from the bottom
  std::vector<Tick> ticks;
};

struct Annotations {
  bool axes = false, scale_bar = false;
  std::vector<Swatch> legend;  // empty for no legend
  std::optional<ColourBar> colour_bar = {};

  bool are_none() const { return !axes && !scale_bar && legend.empty() && !colour_bar; }
};

// The layout of a picture: its contents are in the upper left corner, the legend to the right of them, and the rest
// below.
struct Layout {
  int64_t width = 0, height = 0;  // size of the contents in pixels; less than 1 if there is no room
  int text_size = 0;
};
Layout lay_out(int64_t picture_width, int64_t picture_height, const Annotations& annotations, draw::Pen& pen);

// Draws annotations on a picture with a background. `pixel_mm` is the size of a pixel at the middle of the part, for
// which the scale bar holds.
void annotate(const draw::Canvas& picture, const Layout& layout, const Annotations& annotations, const Camera& camera,
              double pixel_mm, const Background& background, draw::Pen& pen);

}  // namespace ombre::render
