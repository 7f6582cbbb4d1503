// What drawings say of themselves: dimensions by name, and where lines cross.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/math/vec.h"
#include "base/text/diagnostic.h"

namespace ombre::formats {

// A DIMENSION: horizontal, vertical, turned or aligned, a radius or a diameter in units of the drawing, an angle in
// degrees, or an ordinate. Nothing for other kinds.
struct DxfDimension {
  std::string name, layer;  // its text
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
};

// Nothing, and diagnostics, for what is no DXF.
std::optional<DxfMeasures> read_dxf_measures(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

}  // namespace ombre::formats
