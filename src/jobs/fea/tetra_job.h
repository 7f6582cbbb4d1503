// Makes finite-element models of tetrahedra.
#pragma once

#include <functional>
#include <optional>

#include "fea/model/element_mesh.h"
#include "jobs/fea/element_size.h"
#include "jobs/fea/fea_sections.h"

namespace ombre::compile {

// Approximate number of tetrahedra, and the memory that they take.
struct TetraPlan {
  double elements = 0, memory_bytes = 0;
};

struct TetraRequest {
  SizeRequest size;
  bool quadratic = false;  // C3D10 instead of C3D4
  // Makes borders between materials faces of elements; each element has the material of its region.
  bool by_material = false;
  FeaRequest sections;
  std::optional<Box> period;  // cube of a periodic mesh, see solids::TetrahedraRequest; mm
  uint64_t seed = 0;          // seed of random draws
  size_t memory_bytes = 0;    // memory limit of meshing; 0: no limit
  std::function<void(const TetraPlan&)> announce = nullptr;  // called before the work; may be empty
};

struct TetraModel {
  fea::MeshModel model;
  fea::MeshQuality quality;
  double surface_mm3 = 0;  // volume within the design's surface, for comparison; 0 if the mesh is periodic
};

// Makes tetrahedra up to the surface of the design. They keep its sharp edges, as the surface mesher sees them at half
// the size. Their fields are the fractions of materials and the attributes at their middles, where their materials are
// also chosen. The same request gives the same bits. Returns nothing, and adds diagnostics, when there is no solid, or
// properties are missing. Throws Error if there is no mesher or too little memory, and Cancelled.
std::optional<TetraModel> tetra_model(const LoadedPtr& loaded, const fea::Study& study, const TetraRequest& request,
                                      Diagnostics& diagnostics, Progress* progress = nullptr,
                                      const StopFlag* stop = nullptr);

}  // namespace ombre::compile
