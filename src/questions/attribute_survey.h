// Surveys a design: its attributes, with the values that they have in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/math/interval.h"
#include "base/text/diagnostic.h"
#include "design/design.h"

namespace ombre::compile {

struct SurveyedAttribute {
  design::AttributeDeclaration declaration;
  // Each number of the attribute with its range, found by samples on a coarse lattice. The range is missing if no
  // sample lies inside or no value is a number.
  std::vector<std::pair<std::string, std::optional<Interval>>> ranges;
};

// Returns nothing, and adds diagnostics, when the design has no bounds or is too large.
std::optional<std::vector<SurveyedAttribute>> survey_attributes(const design::Design& of, Diagnostics& diagnostics);

}  // namespace ombre::compile
