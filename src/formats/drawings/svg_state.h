// The style and place that an element of an SVG file inherits. Only for builds with pugixml.
#pragma once

#include <string_view>
#include <vector>

#include "formats/drawings/plane_files.h"
#include "formats/drawings/svg_style.h"

namespace ombre::formats {

// The style that an element inherits.
struct SvgStyle {
  bool is_visible = true, is_filled = true, is_stroked = false;
  bool is_evenodd = false, is_clip_evenodd = false;
  std::string_view stroke_width = "1", miter_limit = "4";
  bool has_dashes = false;
  StrokeCap cap = StrokeCap::butt;
  StrokeJoin join = StrokeJoin::miter;
};

// The place of an element, and the style that applies to it.
struct SvgState {
  PlaneMap map;
  Vec2 view;  // the viewport's size in the element's units, for percentages
  SvgStyle style;
  std::vector<PlaneClip> clips = {};
  bool is_wanted = true;
  bool is_clip = false;  // the element is part of a clip path
  int depth = 0;
};

// Returns the style of an element with these values of its own, whose parent has the style `outer`.
SvgStyle inherited_style(const SvgStyle& outer, const SvgValues& values);

}  // namespace ombre::formats
