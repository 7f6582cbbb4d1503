// The areas of a design's surfaces, and of the borders between its materials.
#pragma once

#include <map>
#include <string>

#include "jobs/characterise/solid_grid.h"
#include "jobs/mesh/meshed_design.h"

namespace ombre::compile {

struct Surfaces {
  double volume_mm3 = 0;
  double surface_mm2 = 0;  // of the solid, without faces in which a repeating box cuts it
  double inner_mm2 = 0;    // of the solid, without what lies in the faces of the box
  std::map<std::string, double> material_mm3;
  std::map<std::string, double> interface_mm2;  // "red, blue"
};

// Returns what the closed surfaces of the materials have; bodies share the vertices of their borders.
Surfaces surfaces_of(const MeshedDesign& meshed, const Box& box, const Periodic& periodic);

}  // namespace ombre::compile
