// Measures in drawings: named dimensions, and lines whose crossings are needed.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec.h"
#include "base/text/diagnostic.h"

namespace ombre::formats {

// A DIMENSION: horizontal, vertical, rotated or aligned, a radius or a diameter in units of the drawing, an angle in
// degrees, or an ordinate. The value is null for other kinds.
struct DxfDimension {
  std::string name, layer;  // the name is the dimension's text
  std::optional<double> value;
  bool is_angle = false;
};

struct DxfLine {
  std::string layer;
  Vec2 from, to;
};

struct DxfMeasures {
  std::vector<DxfDimension> dimensions;
  std::vector<DxfLine> lines;
  std::vector<std::array<std::string, 2>> others;  // the kind and layer of each other entity
};

// Returns the measures; null, with diagnostics, if the bytes are not DXF.
std::optional<DxfMeasures> read_dxf_measures(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// Returns the names of the layers that have entities, in alphabetical order; none if the bytes are not DXF.
std::vector<std::string> dxf_layers(const std::string& name, std::string_view bytes);

}  // namespace ombre::formats
