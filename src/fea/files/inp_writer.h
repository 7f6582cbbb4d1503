// Input decks of Abaqus and CalculiX.
#pragma once

#include <string>

#include "fea/files/sink.h"
#include "fea/model/model.h"

namespace ombre::fea {

enum class BrickType : uint8_t {
  c3d8,   // full integration
  c3d8i,  // with incompatible modes, for bending
  c3d8r,  // reduced integration, with hourglass control
};

// A flat deck in mm, N, MPa and tonnes that runs as it is, static and linear: nodes and elements from 1, an element set
// and a material for each section that elements have, the conditions' node sets, single-node supports and loads;
// of a cell that repeats equations between its nodes, and three nodes PERIOD_1 to PERIOD_3 behind the mesh's that move
// as what lies a period along x, y, z away moves, so that the forces on them are mean stresses times sides of the cell;
// results U, RF, S and E. Conduction becomes a steady heat transfer, in mW and degrees Celsius, with results NT, RFL
// and HFL; currents stand for heat, so that potentials are temperatures and mA are mW. Names are in capitals, with _
// for what decks do not take. Bricks that are cut have properties times the share that is inside. `type` is that of
// hexahedra in mechanics. With `prints` the results go as text to job.dat, for calculix.h.
void write_inp(const ModelView& model, const Conditions& conditions, BrickType type, const std::string& title,
               const Sink& sink, bool prints = false);

}  // namespace ombre::fea
