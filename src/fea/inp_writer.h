// Input decks of Abaqus and CalculiX.
#pragma once

#include <string>

#include "fea/model.h"
#include "fea/sink.h"

namespace ombre::fea {

enum class BrickType : uint8_t {
  c3d8,   // full integration
  c3d8i,  // with incompatible modes, for bending
  c3d8r,  // reduced integration, with hourglass control
};

// A flat deck in mm, N, MPa and tonnes that runs as it is, static and linear: nodes and elements from 1, an element set
// and a material for each section that bricks have, single-node supports and loads; results U, RF, S and E. Names are
// in capitals, with _ for what decks do not take.
void write_inp(const Model& model, const Conditions& conditions, BrickType type, const std::string& title,
               const Sink& sink);

}  // namespace ombre::fea
