#include "jobs/outline/contour_choices.h"

namespace ombre::compile {

ContourRequest ContourChoices::request() const {
  return {regions.request(), layer_height, z_mm, work.threads, nullptr, work.memory_bytes};
}

}  // namespace ombre::compile
