// The options of queries at single points.
#pragma once

#include <string>
#include <vector>

#include "jobs/common/job_options.h"

namespace ombre::compile {

// Parses a point such as "0,0,2.5"; mm.
Vec3 parse_point(const std::string& text, const std::string& name);
inline constexpr options::Kind<Vec3> point_kind{"3 numbers", parse_point};

struct ProbeChoices {
  DesignOptions design;
  std::vector<Vec3> points;  // mm

  static const options::Spec<ProbeChoices>& options() {
    using namespace options;
    static const options::Spec<ProbeChoices> spec{
        group(&ProbeChoices::design),
        options::list("--at", &ProbeChoices::points, point_kind, "A point, in mm; may be repeated", "X,Y,Z")
            .required()};
    return spec;
  }
};

}  // namespace ombre::compile
