// Writes SVG 1.1: a layer's regions as filled paths, with one unit per millimetre.
#pragma once

#include "formats/drawings/outlines.h"

namespace ombre::formats {

// Returns the layer as seen from above, y up. The picture has the size of the document's box in x and y, and a point
// (x, y) is written as x, -y. Path "region-1" is the first region; empty regions have no path.
std::string svg_bytes(const OutlineDocument& document, const std::string& title, const OutlinePolygons& polygons);

}  // namespace ombre::formats
