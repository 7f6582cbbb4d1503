// How nodes of a design place the struts of their inputs.
#pragma once

#include <optional>
#include <vector>

#include "design/design.h"
#include "nodes/common/struts.h"

namespace ombre::compile {

// The frame of a node's inputs, and how often the node repeats them.
struct InputFrame {
  Affine here_from_input;
  std::optional<nodes::TileCopies> copies = {};  // of tiles
};

// Returns the frame of the inputs of tiles, affine maps, unions, intersections, differences, and nodes that keep the
// shape of their input. Returns nothing for other nodes, which may change struts in other ways.
std::optional<InputFrame> input_frame(const design::Node& node);

// Returns true for unions, intersections and differences.
bool is_boolean(const design::Node& node);

// Returns the factor of a map that changes all lengths by one factor.
std::optional<double> scale_of_similarity(const Affine& map);

// Each returns a box around the struts.
Box reach(const nodes::StrutShape& strut);
Box reach(const std::vector<nodes::StrutShape>& struts);

// Returns a node that is the solid which a parameter of another node holds.
design::NodePtr solid_of(const Data& held, const design::MaterialTable& materials, const SourceRange& where,
                         Diagnostics& diagnostics);

}  // namespace ombre::compile
