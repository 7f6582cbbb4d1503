// Colours of the vertices of meshes.
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
  std::string palette = {};       // of numbers: one of palettes(); empty: the usual one
  std::optional<Interval> range;  // that it spans; nothing: from the least to the greatest at the vertices
};

// Gives each vertex of the bodies the colour that the design has there: of a colour attribute (or a vector, as red,
// green and blue) its own, of a number one of the palette. False, and diagnostics, when the design has no such
// attribute.
bool colour_vertices(const Loaded& loaded, const VertexColouring& colouring, formats::MeshDocument& document,
                     Diagnostics& diagnostics, int threads = 0, const StopFlag* stop = nullptr);

}  // namespace ombre::compile
