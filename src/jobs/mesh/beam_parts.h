// A design cut into struts, which can be written as beams, and the rest.
#pragma once

#include <optional>
#include <vector>

#include "design/design.h"
#include "formats/mesh/beam_lattice.h"
#include "nodes/common/struts.h"

namespace ombre::compile {

// Struts of which the same part is there: all, or what lies inside or outside of a solid. All in the design's frame.
struct BeamSet {
  std::vector<nodes::StrutShape> struts;
  formats::LatticeClipping clipping = formats::LatticeClipping::none;
  design::NodePtr clip;  // null where there is no clipping
};

struct BeamParts {
  std::vector<BeamSet> sets;  // not empty; each has struts
  design::NodePtr rest;       // null: all of the design are the struts
};

// Searches for lattices through unions, similarities, nodes that give materials, tiles, and sharp intersections and
// differences with other solids, which become clips. Where other nodes stand above struts, these stay in the rest, with
// a warning that counts them. On up to `threads` threads; 0: all cores. Nothing, and diagnostics, where there are no
// struts, or too many.
std::optional<BeamParts> split_beams(const design::Design& design, int threads, Diagnostics& diagnostics);

// A bounded solid that clips the struts as the set's clip does: the clip, cut off around them.
design::NodePtr clip_near_struts(const design::Design& design, const BeamSet& set, Diagnostics& diagnostics);

}  // namespace ombre::compile
