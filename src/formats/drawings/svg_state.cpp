#include "formats/drawings/svg_state.h"

#ifdef OMBRE_3MF

namespace ombre::formats {

SvgStyle inherited_style(const SvgStyle& outer, const SvgValues& values) {
  SvgStyle style = outer;
  for (const auto& [name, text] : values) {
    if (text == "inherit") continue;
    if (name == "visibility") style.is_visible = text == "visible";
    if (name == "fill") style.is_filled = text != "none" && text != "transparent";
    if (name == "stroke") style.is_stroked = text != "none" && text != "transparent";
    if (name == "fill-rule") style.is_evenodd = text == "evenodd";
    if (name == "clip-rule") style.is_clip_evenodd = text == "evenodd";
    if (name == "stroke-width") style.stroke_width = text;
    if (name == "stroke-miterlimit") style.miter_limit = text;
    if (name == "stroke-dasharray") style.has_dashes = text != "none" && !text.empty();
    if (name == "stroke-linecap")
      style.cap = text == "round" ? StrokeCap::round : text == "square" ? StrokeCap::square : StrokeCap::butt;
    if (name == "stroke-linejoin")
      style.join = text == "round" ? StrokeJoin::round : text == "bevel" ? StrokeJoin::bevel : StrokeJoin::miter;
  }
  return style;
}

}  // namespace ombre::formats

#endif
