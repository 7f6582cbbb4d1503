// Colours of surfaces as field sources.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/mesh/mesh.h"
#include "program/field_source.h"

namespace ombre::importing {

// Pixels in rows from the top, with four bytes each: red, green, blue and alpha in sRGB.
struct SurfaceImage {
  size_t columns = 0, rows = 0;
  std::vector<uint8_t> rgba;
  formats::ImageWrap wrap_u = formats::ImageWrap::repeat, wrap_v = formats::ImageWrap::repeat;
};

// Returns a source with the channels "red", "green", "blue" and "alpha", from 0 to 1 in sRGB: the colour of the nearest
// point of the mesh, as its triangle's shading says. The mesh has a shading for each triangle, and `images` are those
// that they name. `content` is the hash of the files' bytes.
program::SourceField make_surface_colours(std::string name, formats::Mesh mesh, std::vector<SurfaceImage> images,
                                          Hash content);

}  // namespace ombre::importing
