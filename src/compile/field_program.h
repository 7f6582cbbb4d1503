// A design's distance and fractions as a program of numbers.
#pragma once

#include <optional>
#include <vector>

#include "base/run.h"
#include "design/design.h"
#include "program/program.h"

namespace ombre::compile {

struct FieldWishes {
  bool distance = false;
  std::optional<double> band_mm;      // distances are cut off there, on both sides of the surface
  std::vector<MaterialId> fractions;  // of these materials
};

// Outputs: the distance, mm, if it is wished for; then each of the fractions, as dithering takes them and 0
// outside. Without calls. Nothing, and a diagnostic, when it would not fit into memory.
std::optional<program::Program> build_field_program(const design::Design& design, const FieldWishes& wishes,
                                                    Diagnostics& diagnostics);

}  // namespace ombre::compile
