// Finite-element models of tetrahedra.
#pragma once

#include <functional>
#include <optional>

#include "fea/model/element_mesh.h"
#include "jobs/fea/element_size.h"
#include "jobs/fea/fea_sections.h"

namespace ombre::compile {

// About how many tetrahedra there will be, and the memory that they take.
struct TetraPlan {
  double elements = 0, memory_bytes = 0;
};

struct TetraRequest {
  SizeRequest size;
  bool quadratic = false;    // C3D10 in place of C3D4
  bool by_material = false;  // borders between materials become faces of elements; each has the one of its region
  FeaRequest sections;
  std::optional<Box> period;  // a cube after which the mesh repeats: see solids::TetrahedraRequest; mm
  uint64_t seed = 0;          // of random draws
  size_t memory_bytes = 0;    // most that meshing may take; 0: no limit
  std::function<void(const TetraPlan&)> announce = nullptr;  // called before the work; may be empty
};

struct TetraModel {
  fea::MeshModel model;
  fea::MeshQuality quality;
  double surface_mm3 = 0;  // the volume within the design's surface, to compare; 0 where the mesh repeats
};

// Tetrahedra up to the surface of the design, whose sharp edges they keep, as the surface mesher sees them at half the
// size. Their fields are the fractions of materials and the attributes at their middles, where their materials are
// chosen too. The same request gives the same bits. Nothing, and diagnostics, when there is no solid, or properties are
// missing. Throws Error where there is no mesher or too little memory, and Cancelled.
std::optional<TetraModel> tetra_model(const LoadedPtr& loaded, const fea::Study& study, const TetraRequest& request,
                                      Diagnostics& diagnostics, Progress* progress = nullptr,
                                      const StopFlag* stop = nullptr);

}  // namespace ombre::compile
