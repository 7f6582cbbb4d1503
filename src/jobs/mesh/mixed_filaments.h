// Mixtures of two filaments, which slicers print by changing from layer to layer.
#pragma once

#include <optional>

#include "formats/mesh/mesh_document.h"
#include "jobs/common/events.h"
#include "jobs/mesh/meshed_design.h"
#include "load/loaded.h"

namespace ombre::jobs {

// Cycles of up to this many layers have shares that PrusaSlicer, which looks for the shortest cycle within 3 %, keeps.
inline constexpr int longest_cycle = 6;

// The layers of the first of two filaments, within a cycle.
struct LayerCycle {
  int first = 0, layers = 1;
  double share() const { return static_cast<double>(first) / layers; }
};

// Returns the cycle of at most `most` layers whose share of the first filament is nearest; of equal ones the shortest.
LayerCycle nearest_cycle(double share, int most);

// Gives the document two filaments and their mixtures, and its bodies, which are those of the design, their extruders.
// Throws WrongArgument unless the bodies are bands of a mixture of two materials.
void add_mixed_filaments(const compile::Loaded& loaded, const compile::MeshedDesign& made, int most_layers,
                         const Events& events, Diagnostics& diagnostics, formats::MeshDocument& document);

}  // namespace ombre::jobs
