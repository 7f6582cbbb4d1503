// A partition of space into regions, as contouring evaluates it.
#pragma once

#include <cstdint>
#include <vector>

#include "program/program.h"
#include "surface/cells/local_programs.h"

namespace ombre::surface {

// The number of a region; 0 is void, regions count from 1.
using Label = uint16_t;

// The rule that decides between two regions inside the solid.
enum class Division : uint8_t {
  bands,     // by one score: region n + 1 is where exactly n of the borders are less than or equal to it
  greatest,  // by one score per region: the greatest wins, the first if several are equal
};

// Programs that define the partition; they contain no calls.
struct Partition {
  program::Program label;  // one output: the number of the region
  // Outputs: the number of the region, g (negative inside, 0 on the surface), then the scores.
  LocalPrograms details;
  enum Output : size_t { label_output, distance_output, first_score };
  Division division = Division::bands;
  std::vector<double> borders;  // borders of the bands, ascending
  size_t regions = 1;
};

}  // namespace ombre::surface
