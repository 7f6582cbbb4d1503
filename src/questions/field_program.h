// A design's distance, fractions and attributes as a program of numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/run.h"
#include "design/design.h"
#include "program/program.h"

namespace ombre::compile {

struct FieldQuery {
  bool distance = false;
  std::optional<double> band_mm;      // distances are cut off there, on both sides of the surface
  std::vector<MaterialId> fractions;  // of these materials
  std::vector<std::string> attributes;
  bool inside = false;  // 1 inside, 0 outside
};

// Outputs: the distance, mm, if it is requested; each of the fractions, as dithering takes them and 0 outside; each of
// the attributes, which have their default outside; and `inside`. Without calls. Nothing, and a diagnostic, when it
// would not fit into memory or the design has no such attribute.
std::optional<program::Program> build_field_program(const design::Design& design, const FieldQuery& query,
                                                    Diagnostics& diagnostics);

}  // namespace ombre::compile
