// Evaluates the fields that a stage reads, on its lattice.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/system/progress.h"
#include "design/design.h"
#include "voxel/fields.h"
#include "voxel/layers.h"

namespace ombre::compile {

// The values that a stage reads. Thread-safe once it is built.
class StageInput {
 public:
  // An evaluator of the fields of one solid, whose channels begin with `first`.
  struct Evaluator {
    size_t first_channel = 0;
    std::shared_ptr<const voxel::LayerEvaluator> shape;  // set if only "inside" is read
    std::shared_ptr<const voxel::FieldEvaluator> fields;
  };
  StageInput(std::vector<design::StageChannel> channels, std::vector<Evaluator> evaluators, bool is_zero_outside)
      : channels_(std::move(channels)), evaluators_(std::move(evaluators)), is_zero_outside_(is_zero_outside) {}

  const std::vector<design::StageChannel>& channels() const { return channels_; }
  // True if all values are 0 outside of the solids.
  bool is_zero_outside() const { return is_zero_outside_; }
  // Evaluates the cells of a box. Values do not depend on the choice of boxes. Throws Cancelled soon after `stop` is
  // set.
  design::StageValues values(const IndexBox& box, const StopFlag* stop) const;

 private:
  std::vector<design::StageChannel> channels_;
  std::vector<Evaluator> evaluators_;
  bool is_zero_outside_ = true;
};

// A function that makes programs of the fields that a stage reads. `job` has the scale, the lattice, the stages and the
// materials for the solids' own space. Throws Error when a solid's program would be too large.
using MakeStageInput = StageInput (*)(const design::Design& job, const std::vector<design::StageRead>& reads,
                                      const voxel::Lattice& lattice);

}  // namespace ombre::compile
