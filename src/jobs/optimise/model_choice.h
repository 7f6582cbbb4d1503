// How a study of optimisation makes models of designs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/math/pitch.h"
#include "base/text/record.h"
#include "fea/solve/solve_options.h"
#include "jobs/fea/fea_job.h"
#include "jobs/fea/section_options.h"

namespace ombre::compile {

struct ModelChoice {
  std::array<std::optional<Pitch>, 3> cell;           // size of the bricks
  std::optional<std::array<int64_t, 3>> brick_count;  // or into how many the design's box is cut along each axis
  // Draws change by leaps where a design changes little, and mean properties do not.
  SectionOptions sections{.assign = FeaRequest::Assign::mix, .sections = 1000};
  std::string solver = "multigrid";
  fea::Study fea;
};

enum class Solves { once, often };  // a topology solves the same bricks again and again, in a way of its own

// The members "fea", "cell" or "bricks", and those that `ombre fea` has as options: "assign", "modulus",
// "conductivity", "sections"; where designs are solved once, "fill" and "solver" as well. Reading them throws Error for
// a file that cannot be read.
Record<ModelChoice> model_record(Solves solves);

}  // namespace ombre::compile
