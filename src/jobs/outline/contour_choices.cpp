#include "jobs/outline/contour_choices.h"

namespace ombre::compile {

ContourRequest ContourChoices::request() const {
  return {regions.request(), layer_height, z_mm, work.threads, nullptr, work.memory_bytes};
}

formats::CliRules ContourChoices::cli() const {
  formats::CliRules rules{binary, std::nullopt};
  if (hatch_mm) rules.hatch = formats::HatchRule{*hatch_mm, hatch_angle, hatch_turn};
  return rules;
}

}  // namespace ombre::compile
