// Evaluates a program at one point after another, many of which lie close together.
#pragma once

#include <array>
#include <map>

#include "eval/rows.h"
#include "surface/cells/local_programs.h"

namespace ombre::compile {

// Evaluates a program at points, for one thread. Long programs, and those of many parts, are shortened for cells of
// space, once for all points there.
class PointValues {
 public:
  // Makes an object that must not be asked for values.
  PointValues() = default;
  // Points lie mostly within `space`, and neighbours about `cell_mm` apart.
  PointValues(program::Program program, const Box& space, double cell_mm);

  // Returns the first output at p, in double precision.
  double at(Vec3 p);

 private:
  const program::Program& around(Vec3 p);

  surface::LocalPrograms programs_;
  double cell_mm_ = 1;
  size_t operations_ = 0;  // sum over all cells
  std::map<std::array<int64_t, 3>, program::Program> cells_;
  eval::RowEvaluator rows_{1};
};

}  // namespace ombre::compile
