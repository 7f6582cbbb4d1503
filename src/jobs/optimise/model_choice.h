// How a study of optimisation makes models of designs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/math/pitch.h"
#include "base/text/record.h"
#include "jobs/fea/fea_job.h"

namespace ombre::compile {

struct ModelChoice {
  std::array<std::optional<Pitch>, 3> cell;           // size of the bricks
  std::optional<std::array<int64_t, 3>> brick_count;  // or into how many the design's box is cut along each axis
  // Draws change by leaps where a design changes little, and mean properties do not.
  FeaRequest request{.assign = FeaRequest::Assign::mix, .most_sections = 1000};
  fea::Study fea;
};

// The members "fea", "cell" or "bricks", "assign", "modulus" and "sections" of a study, and perhaps "fill". Reading
// them throws Error for a file that cannot be read.
Record<ModelChoice> model_record(bool chooses_fill);

}  // namespace ombre::compile
