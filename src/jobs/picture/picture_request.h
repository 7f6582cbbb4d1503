// What a picture shows, and how.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "design/sub_design_memory.h"
#include "jobs/picture/design_scene.h"
#include "render/shade.h"

namespace ombre::compile {

// A plane x, y or z = mm. `removed`: '>' or '<' for the side that is left away, '=' for that of the eye.
struct CutSide {
  int axis = 2;
  char removed = '=';
  double mm = 0;
};
// What lies on all these sides is left away: one plane cuts, two or three take a wedge out.
using CutRequest = std::vector<CutSide>;
// "x=0", "z>3.5", "x>0, y < -2". At most one plane for each axis.
std::optional<CutRequest> parse_cut(std::string_view text);

// A plane x, y or z = mm, seen flat: from the right, from the front or from above.
struct SliceView {
  int axis = 2;
  double mm = 0;
};
// "z=3.2".
std::optional<SliceView> parse_slice(std::string_view text);

// What is drawn beside the part, for which it makes room.
struct AnnotationRequest {
  bool axes = false, scale_bar = false, legend = false;
  std::string font_file;  // empty: one of the system's
};

// What is drawn on the part: the borders of its parts or materials as seen, and their names.
struct OverlayRequest {
  std::optional<Divided> outlines, names;
};

struct PictureRequest {
  int64_t width = 800, height = 600;  // pixels
  int64_t samples = 2;                // rays for each pixel: samples x samples
  render::ViewOptions view;
  std::optional<SliceView> slice;  // in place of the view; of that its zoom counts
  std::vector<CutRequest> cuts;
  std::optional<Box> box;
  std::vector<std::pair<std::string, double>> opacity;  // by the name of the material
  // Colours by this material's fraction, this attribute, or "parts"; empty: the materials' own.
  std::string by;
  std::string palette;  // one of palettes(); empty: the usual one
  std::optional<Interval>
      range;  // that they span; nothing: from the least to the greatest value inside, of a fraction 0 to 1
  render::Background background;
  AnnotationRequest annotations;
  OverlayRequest overlays;
  int frames = 1;  // around the part
  int threads = 0;
  size_t memory_bytes = size_t{4} << 30;  // for rays, pixels and stages
  // Where what is made of sub-designs is kept for other pictures, and found; null: nowhere. It must live as long.
  design::SubDesignMemory* memory = nullptr;
};

struct Picture {
  std::vector<uint8_t> rgba;      // rows from the top
  double pixel_mm = 0;            // at the part's middle
  std::optional<Interval> range;  // that the colours span, where they show an attribute of numbers or a fraction
};

}  // namespace ombre::compile
