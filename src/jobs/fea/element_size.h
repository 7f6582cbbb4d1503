// The wanted size of elements: constant, or by a formula.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "questions/nearby_values.h"
#include "stages/job_stages.h"
#include "stages/stage_work.h"

namespace ombre::compile {

struct SizeRequest {
  double least_mm = 0, most_mm = 0;  // min_cell and max_cell; equal for a constant size
  std::string formula;               // empty: the size is least_mm
};

// Evaluates the size of elements; each thread needs an object of its own.
class ElementSize {
 public:
  // The formula may use the coordinates of all formulas, min_cell and max_cell, the attributes, and h, the
  // heterogeneity of the mixture (2025 paper, Eq. 1). This is the distance of the fractions from equal shares of all
  // materials: 1 for one material, and 0 for equal shares. Returns nothing, and adds diagnostics, when the formula is
  // wrong.
  static std::optional<ElementSize> build(const design::Design& design, const Box& box, const SizeRequest& request,
                                          Diagnostics& diagnostics);

  // Returns the size at p in mm, from least_mm to most_mm.
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
