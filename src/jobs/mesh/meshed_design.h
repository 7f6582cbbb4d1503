// The request for closed surfaces of a design, and what is made of it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "jobs/mesh/beam_bodies.h"
#include "questions/region_request.h"
#include "questions/region_survey.h"
#include "surface/mesh/bodies.h"

namespace ombre::compile {

// Estimates for a mesh, from its surface on a coarse grid.
struct MeshPlan {
  double tolerance_mm = 0, cell_mm = 0;
  double cells = 0;  // at borders, before any are cut
  double memory_bytes = 0;
};

// The treatment of several materials if nobody chose regions.
enum class UsualRegions : uint8_t {
  as_requested,  // the regions of the request
  separate,      // none are joined: a body for each material, or bands of mixtures; with beams, materials
  joined,        // the whole is one body
};

struct MeshRequest : RegionRequest {
  UsualRegions usual = UsualRegions::as_requested;  // not with regions of other kinds
  bool keeps_polyhedra = false;  // solids that are polyhedra keep their triangles, without cells (exact_bodies.h)
  bool beams = false;            // struts become beams if possible; not with bands
  bool join_flat = true;         // cells are joined where the surface is flat
  int threads = 0;
  size_t memory_bytes = 0;                                       // memory limit of cells; 0: no limit
  std::function<void(const MeshPlan& plan)> announce = nullptr;  // called before each surface; may be empty
};

struct RegionBody {
  Region region;
  double share = 0;  // place of the region among all of the design's, from 0 for the first to 1 for the last
  design::Rgba colour{};
  surface::Body body;
  double volume_mm3 = 0, area_mm2 = 0;
};

struct MeshedDesign {
  std::vector<RegionBody> bodies;    // without empty ones
  std::vector<BeamBody> beams;       // only if beams were requested; not counted among the bodies
  std::vector<surface::Body> clips;  // solids that clip the beams
  double tolerance_mm = 0, cell_mm = 0;
  bool is_coarser = false;  // the default tolerance was increased, since there would be many cells
  surface::ContourReport report;
  MaterialsInside materials;  // set if nobody chose regions
  bool is_by_bands = false;   // bodies are bands of a mixture
  bool is_exact = false;      // the triangles are those of the design's polyhedra; tolerance and cells are then 0
};

}  // namespace ombre::compile
