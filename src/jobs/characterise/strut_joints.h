// Counts the joints and struts of graphs of straight struts.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "jobs/characterise/spread.h"
#include "jobs/characterise/strut_crossings.h"

namespace ombre::compile {

// A graph of struts, of which those that go on straight from one to the next count as one. Joints are where struts end
// on each other or cross.
struct StrutGraph {
  size_t joints = 0, struts = 0;
  std::map<size_t, size_t> joints_of_degree;  // by the number of struts that meet at them
  Spread length;                              // mm
  Spread slenderness;                         // 2 L / r, the length over the radius of gyration; 0: not known

  // Struts - 3 joints + 6: below 0, struts on joints that are pins cannot be rigid (Maxwell 1864).
  int64_t maxwell() const { return static_cast<int64_t>(struts) - 3 * static_cast<int64_t>(joints) + 6; }
};

// Returns the graph. Where `period` is above 0, struts repeat without end along that axis, and the graph is that of one
// period; a straight line that meets nothing has one joint in each period. Lengths are measured after the map
// `mm_from_here`.
StrutGraph graph_of(const std::vector<GraphStrut>& struts, Vec3 period = {}, const Affine& mm_from_here = {});

}  // namespace ombre::compile
