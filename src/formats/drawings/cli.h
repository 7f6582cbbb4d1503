// Common Layer Interface, version 2.0, ASCII: outlines of all layers in one file, for machines that draw them.
#pragma once

#include "formats/drawings/outlines.h"

namespace ombre::formats {

// A file is a header, a layer without polygons at the height where the first layer begins, the layers from the lowest
// to the highest, and an end. Units are millimetres. Region 1 has the id 1.
std::string cli_header(const OutlineDocument& document, uint64_t layers, double bottom_mm);
// `top_mm` is the height of the layer's upper face. Polygons repeat their first point.
std::string cli_layer(double top_mm, const OutlinePolygons& polygons);
std::string cli_end();

}  // namespace ombre::formats
