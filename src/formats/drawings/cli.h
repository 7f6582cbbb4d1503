// Writes Common Layer Interface files, version 2.0, ASCII: outlines of all layers in one file, for machines that trace
// outlines.
#pragma once

#include "formats/drawings/outlines.h"

namespace ombre::formats {

// Returns the header. A file consists of a header, a layer without polygons at the height where the first layer begins,
// the layers in ascending order, and an end. Units are millimetres. Region 1 has the id 1.
std::string cli_header(const OutlineDocument& document, uint64_t layers, double bottom_mm);
// Returns a layer; `top_mm` is the height of its upper face. Polygons repeat their first point.
std::string cli_layer(double top_mm, const OutlinePolygons& polygons);
std::string cli_end();

}  // namespace ombre::formats
