// Axes, a scale bar and a legend beside what a picture shows.
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

// A bar of the colours of numbers, the greatest on top.
struct ColourBar {
  struct Tick {
    double share = 0;  // of the bar, from 0 below to 1 on top
    std::string text;
  };
  std::string title;
  std::vector<Rgba8> colours;  // from below
  std::vector<Tick> ticks;
};

struct Annotations {
  bool axes = false, scale_bar = false;
  std::vector<Swatch> legend;  // empty: none
  std::optional<ColourBar> colour_bar = {};

  bool are_none() const { return !axes && !scale_bar && legend.empty() && !colour_bar; }
};

// What a picture shows lies in its left upper corner, with the legend to the right of it and the rest below.
struct Layout {
  int64_t width = 0, height = 0;  // of what it shows, pixels; less than 1 where there is no room
  int text_size = 0;
};
Layout lay_out(int64_t picture_width, int64_t picture_height, const Annotations& annotations, draw::Pen& pen);

// The longest of 1, 2, 5, 10, ... mm (or 0.5, 0.2, ...) that is not longer than this.
double round_length(double most_mm);

// On a picture with a background. `pixel_mm` is at the part's middle, for which the scale bar holds.
void annotate(const draw::Canvas& picture, const Layout& layout, const Annotations& annotations, const Camera& camera,
              double pixel_mm, const Background& background, draw::Pen& pen);

}  // namespace ombre::render
