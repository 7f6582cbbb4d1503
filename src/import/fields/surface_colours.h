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
};

// Returns a source with the channels "red", "green", "blue" and "alpha", from 0 to 1 in sRGB: the colour of the nearest
// point of the mesh. That is the one of the image at the point's texture coordinates, which repeat beyond 0 to 1, or
// without an image the mean of the colours of the triangle's corners. The mesh has the one or the other. `content` is
// the hash of the files' bytes.
program::SourceField make_surface_colours(std::string name, formats::Mesh mesh, SurfaceImage image, Hash content);

}  // namespace ombre::importing
