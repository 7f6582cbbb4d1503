// Space cut into regions: what contouring asks of a design.
#pragma once

#include <cstdint>
#include <vector>

#include "program/program.h"
#include "surface/cells/local_programs.h"

namespace ombre::surface {

// Which region a point is in: 0 is void, regions count from 1.
using Label = uint16_t;

// How regions are distinguished where both sides are inside.
enum class Division : uint8_t {
  bands,     // by one score: region n + 1 lies where exactly n of the borders are at or below it
  greatest,  // by a score for each region: the greatest decides, the first of equals
};

// Programs are without calls.
struct Partition {
  program::Program label;  // one output: the region's number
  // Outputs: the region's number, g (negative inside, 0 on the surface), then the scores.
  LocalPrograms details;
  enum Output : size_t { label_output, distance_output, first_score };
  Division division = Division::bands;
  std::vector<double> borders;  // of bands; increasing
  size_t regions = 1;
};

}  // namespace ombre::surface
