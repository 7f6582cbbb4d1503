// The request of a picture.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "design/sub_design_memory.h"
#include "jobs/picture/cut_faces.h"
#include "jobs/picture/design_scene.h"
#include "render/shade.h"

namespace ombre::compile {

// A plane x, y or z = mm. `removed` is the side that is cut away: '>', '<', or '=' for that of the eye.
struct CutSide {
  int axis = 2;
  char removed = '=';
  double mm = 0;
};
// A cut removes the part on all these sides: one plane cuts, two or three take a wedge out.
using CutRequest = std::vector<CutSide>;
// Parses "x=0", "z>3.5", "x>0, y < -2". There is at most one plane for each axis.
std::optional<CutRequest> parse_cut(std::string_view text);

// A plane x, y or z = mm, seen flat: from the right, from the front or from above.
struct SliceView {
  int axis = 2;
  double mm = 0;
};
// Parses "z=3.2".
std::optional<SliceView> parse_slice(std::string_view text);

// Annotations beside the part, which makes room for them.
struct AnnotationRequest {
  bool axes = false, scale_bar = false, legend = false;
  std::string font_file;  // empty: a font of the system
};

// Overlays on the part: the visible borders of its parts or materials, and their names.
struct OverlayRequest {
  std::optional<Divided> outlines, names;
};

struct PictureRequest {
  int64_t width = 800, height = 600;  // pixels
  int64_t samples = 2;                // rays for each pixel: samples x samples
  render::ViewOptions view;
  std::optional<SliceView> slice;  // replaces the view, except for its zoom
  std::vector<CutRequest> cuts;
  std::optional<Box> box;
  std::vector<std::pair<std::string, double>> opacity;  // by the name of the material
  // Colours by this material's fraction, this attribute, or "parts"; empty: the materials' own.
  std::string by;
  std::string palette;  // one of palettes(); empty: the default one
  // Range of the colours; nothing: from the least to the greatest value inside, for a fraction 0 to 1.
  std::optional<Interval> range;
  FaceColours face_colours = nullptr;  // of the faces of cuts, instead of the design's own; null: these
  render::Background background;
  AnnotationRequest annotations;
  OverlayRequest overlays;
  int frames = 1;  // around the part
  int threads = 0;
  size_t memory_bytes = size_t{4} << 30;           // for rays, pixels and stages
  std::function<bool(int frame)> wants = nullptr;  // takes no picture of frames for which it returns false
  // Memory that keeps results of sub-designs for other pictures; null: they are not kept. It must outlive the request.
  design::SubDesignMemory* memory = nullptr;
};

struct Picture {
  std::vector<uint8_t> rgba;      // rows from the top
  double pixel_mm = 0;            // at the part's middle
  std::optional<Interval> range;  // range of the colours, if they show an attribute of numbers or a fraction
};

}  // namespace ombre::compile
