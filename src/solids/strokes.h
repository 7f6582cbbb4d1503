// Areas of lines with a width.
#pragma once

#include "formats/drawings/plane_files.h"
#include "solids/solid.h"

namespace ombre::solids {

// Returns the area of a stroke with its caps and joins (SVG 1.1, section 11.4), in mm.
Region stroked(const formats::PlaneStroke& stroke, const Fragments& fragments);

}  // namespace ombre::solids
