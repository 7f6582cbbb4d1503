// Decides how a study of optimisation makes models of designs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/math/pitch.h"
#include "jobs/fea/fea_job.h"
#include "jobs/optimise/study_reader.h"

namespace ombre::compile {

struct ModelChoice {
  std::array<std::optional<Pitch>, 3> cell;           // size of the bricks
  std::optional<std::array<int64_t, 3>> brick_count;  // number of bricks along each axis of the design's box
  FeaRequest request;
  fea::Study fea;
};

// Names of the members of a study that decide its models.
inline const std::vector<std::string> model_members{"fea", "cell", "bricks", "assign", "modulus", "sections"};
std::optional<ModelChoice> read_model_choice(StudyMembers& members, Diagnostics& diagnostics);

}  // namespace ombre::compile
