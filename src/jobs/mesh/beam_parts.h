// Splits a design into struts, which can be written as beams, and the rest.
#pragma once

#include <optional>
#include <vector>

#include "design/design.h"
#include "formats/mesh/beam_lattice.h"
#include "nodes/common/struts.h"

namespace ombre::compile {

// Struts with the same clip, in the design's frame: they are whole, or keep what lies inside or outside of a solid.
struct BeamSet {
  std::vector<nodes::StrutShape> struts;
  formats::LatticeClipping clipping = formats::LatticeClipping::none;
  design::NodePtr clip;  // null: the struts are whole
};

struct BeamParts {
  std::vector<BeamSet> sets;  // not empty; each set has struts
  design::NodePtr rest;       // null: the design has only struts
};

// Searches for struts through unions, similarities, nodes that give materials, tiles, and sharp intersections and
// differences with other solids, which become clips. Struts below other nodes stay in the rest, with a warning that
// counts them. Runs on up to `threads` threads; 0: all cores. Returns nothing, and adds diagnostics, if there are no
// struts, or too many.
std::optional<BeamParts> split_beams(const design::Design& design, int threads, Diagnostics& diagnostics);

// Removes struts of which the clip clearly leaves nothing, by the distance of their middles. Runs on up to `threads`
// threads; 0: all cores.
void leave_out_clipped(BeamSet& set, const design::MaterialTable& materials, int threads);

// Returns true if the node does not blend its inputs where they meet.
bool is_sharp(const design::Node& node);

// Returns a bounded solid that clips the struts as the set's clip does: the clip, cut off around them.
design::NodePtr clip_near_struts(const design::Design& design, const BeamSet& set, Diagnostics& diagnostics);

}  // namespace ombre::compile
