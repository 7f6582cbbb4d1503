// Colours the vertices of meshes.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "formats/mesh/mesh_document.h"
#include "load/loaded.h"

namespace ombre::compile {

struct VertexColouring {
  std::string by;                 // an attribute; or "materials", for the colours of their mixture
  std::string palette = {};       // for numbers: one of palettes(); empty: the default one
  std::optional<Interval> range;  // range of the palette; nothing: from the least to the greatest at the vertices
};

// Gives each vertex of the bodies the colour of the design there. A colour attribute (or a vector, as red, green and
// blue) gives its own colour, a number one of the palette. Returns false, and adds diagnostics, when the design has no
// such attribute.
bool colour_vertices(const Loaded& loaded, const VertexColouring& colouring, formats::MeshDocument& document,
                     Diagnostics& diagnostics, int threads = 0, const StopFlag* stop = nullptr);

// Returns the byte of a colour's part between 0 and 1.
uint8_t colour_byte(double share);

}  // namespace ombre::compile
