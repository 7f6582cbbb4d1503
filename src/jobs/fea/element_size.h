// The wanted size of elements: one for all, or by a formula.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "questions/nearby_values.h"
#include "stages/job_stages.h"
#include "stages/stage_work.h"

namespace ombre::compile {

struct SizeRequest {
  double least_mm = 0, most_mm = 0;  // min_cell and max_cell; the same for one size
  std::string formula;               // empty: least_mm
};

// Each thread has one of its own.
class ElementSize {
 public:
  // The formula knows x, y and z and what else formulas know, min_cell and max_cell, the attributes, and h, the
  // heterogeneity of the mixture (2025 paper, Eq. 1): the distance of the fractions from a mixture of equal shares of
  // all materials, 1 where there is one material, and 0 where all are equal. Nothing, and diagnostics, when it is
  // wrong.
  static std::optional<ElementSize> build(const design::Design& design, const Box& box, const SizeRequest& request,
                                          Diagnostics& diagnostics);

  // mm; from least_mm to most_mm.
  double at(Vec3 p);
  double least_mm() const { return request_.least_mm; }
  double most_mm() const { return request_.most_mm; }
  bool is_one() const { return request_.formula.empty(); }

 private:
  SizeRequest request_;
  JobStagesPtr stages_;
  PointValues values_;
};

}  // namespace ombre::compile
