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
  std::optional<double> band_mm;      // distances are limited to this, on both sides of the surface
  std::vector<MaterialId> fractions;  // materials whose fractions are requested
  std::vector<std::string> attributes;
  bool inside = false;  // 1 inside, 0 outside
};

// Builds a program without calls. Its outputs are the requested ones: the distance, mm; the fractions as dithering
// takes them, 0 outside; the attributes, which have their default outside; and `inside`. Returns nothing, and adds a
// diagnostic, if it would not fit into memory or the design lacks an attribute.
std::optional<program::Program> build_field_program(const design::Design& design, const FieldQuery& query,
                                                    Diagnostics& diagnostics);

}  // namespace ombre::compile
