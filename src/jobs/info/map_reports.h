// Surveys how large the maps of a design make their cells, and how they stretch them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/vec.h"
#include "base/text/data.h"
#include "design/design.h"

namespace ombre::compile {

// The least and the greatest of some values, and the places of both, mm.
struct Extremes {
  double least = 0, greatest = 0;
  Vec3 least_at, greatest_at;
};

// Values at points of the region of a map.
struct MapReport {
  std::string node;
  int line = 0;  // of the script; 0 if unknown
  size_t points = 0;
  Extremes volume_mm3;  // of a cell that is everywhere as at the point: the determinant of the map's derivatives
  Extremes stretch_mm;  // lengths to which the map stretches 1 cell
  Extremes aspect;      // greatest stretch over the least

  std::string text() const;
  DataMembers data() const;
};

// Returns a report of each map that has a bounded region.
std::vector<MapReport> map_reports_of(const design::Design& design);

}  // namespace ombre::compile
