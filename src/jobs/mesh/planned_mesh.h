// Meshes that are planned: what is known of them before their surfaces are made.
#pragma once

#include "base/math/box.h"
#include "jobs/mesh/meshed_design.h"
#include "load/loaded.h"
#include "questions/partition_program.h"
#include "surface/mesh/contour_types.h"

namespace ombre::compile {

// A surface of a design, or of a part of it.
struct PlannedSurface {
  design::Design design;  // with sources that are as fine as the tolerance
  RegionProgram program;
  Box box;
  MeshPlan plan;
  bool is_coarser = false;  // as MeshedDesign::is_coarser
  surface::ContourOptions contour;
};

// A mesh without beams, which has one surface.
struct PlannedMesh {
  Loaded loaded;  // keeps the stages of the surface's design
  MaterialsInside materials;
  bool is_by_bands = false;
  PlannedSurface surface;
};

}  // namespace ombre::compile
