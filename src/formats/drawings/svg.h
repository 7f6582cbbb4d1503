// SVG 1.1: a layer's regions as filled paths, one unit a millimetre.
#pragma once

#include "formats/drawings/outlines.h"

namespace ombre::formats {

// As seen from above, y up; the picture is as large as the document's box in x and y, and a point (x, y) is written as
// x, -y. Path "region-1" is the first region; empty regions have none.
std::string svg_bytes(const OutlineDocument& document, const std::string& title, const OutlinePolygons& polygons);

}  // namespace ombre::formats
