// Input decks of Abaqus and CalculiX.
#pragma once

#include <string>

#include "fea/files/sink.h"
#include "fea/model/model.h"

namespace ombre::fea {

enum class BrickType : uint8_t {
  c3d8,   // full integration
  c3d8i,  // incompatible modes, for bending
  c3d8r,  // reduced integration with hourglass control
};

// Writes a flat deck in mm, N, MPa and tonnes that runs as it is, static and linear. It has nodes and elements counted
// from 1, an element set and a material for each section in use, the node sets of the conditions, single-node supports
// and loads, and the results U, RF, S and E.
// A periodic cell also has equations between its nodes, and three nodes PERIOD_1 to PERIOD_3 after those of the mesh.
// Their displacements are the differences over a period along x, y and z, so the forces on them are mean stresses times
// sides of the cell.
// Conduction becomes a steady heat transfer, in mW and degrees Celsius, with results NT, RFL and HFL. Currents are
// written as heat: potentials are temperatures, and mA are mW.
// Names are in capitals, with _ for characters that decks do not take. Cut bricks have properties times the share
// inside. `type` is the kind of hexahedra in mechanics. With `prints` results go as text to job.dat, for calculix.h.
void write_inp(const ModelView& model, const Conditions& conditions, BrickType type, const std::string& title,
               const Sink& sink, bool prints = false);

}  // namespace ombre::fea
