// Represents struts as beams between shared vertices, with their materials.
#pragma once

#include <optional>
#include <vector>

#include "base/system/progress.h"
#include "jobs/mesh/beam_parts.h"

namespace ombre::compile {

struct BeamBody {
  std::vector<Vec3> vertices;         // mm
  std::vector<formats::Beam> beams;   // ends are flat, half balls, or, if both radii are equal, balls
  std::vector<MaterialId> materials;  // materials of the beams, if each has its own
  design::Rgba colour{};              // colour of the whole body
  formats::LatticeClipping clipping = formats::LatticeClipping::none;
  std::optional<size_t> clip;  // index of the clip
};

// Makes beams. Ends that agree within rounding become one vertex, and equal beams become one.
BeamBody beams_of(const BeamSet& set);

// Gives each beam the material of the greatest fraction in the middle of its axis, or at another place that is inside,
// and the body their mean colour; beams of void are left out. Returns the number of beams whose fractions differ by
// more than 1 % between their ends. Returns nothing, and adds diagnostics, if the design is too large. Throws
// Cancelled.
std::optional<size_t> add_materials(const design::Design& design, int threads, BeamBody& body, Diagnostics& diagnostics,
                                    const StopFlag* stop = nullptr);

}  // namespace ombre::compile
