// Struts as beams between shared vertices, and their materials.
#pragma once

#include <optional>
#include <vector>

#include "base/system/progress.h"
#include "jobs/mesh/beam_parts.h"

namespace ombre::compile {

struct BeamBody {
  std::vector<Vec3> vertices;         // mm
  std::vector<formats::Beam> beams;   // flat, or with half balls or, where the radii are equal, balls at their ends
  std::vector<MaterialId> materials;  // of the beams, if each has its own
  design::Rgba colour{};              // of the whole
  formats::LatticeClipping clipping = formats::LatticeClipping::none;
  std::optional<size_t> clip;  // which of the clips
};

// Ends that agree within rounding become one vertex, beams that are there twice become one.
BeamBody beams_of(const BeamSet& set);

// Gives each beam the material of the greatest fraction in the middle of its axis, or where it is inside instead, and
// the body their mean colour; beams of void are left out. Returns how many beams have other fractions, by more than
// 1 %, at one end than at the other. Nothing, and diagnostics, where the design is too large. Throws Cancelled.
std::optional<size_t> add_materials(const design::Design& design, int threads, BeamBody& body, Diagnostics& diagnostics,
                                    const StopFlag* stop = nullptr);

}  // namespace ombre::compile
