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

// Thread-safe once it is built.
class StageInput {
 public:
  // Evaluates what is read of one solid, for the channels from the first on.
  struct Evaluator {
    size_t first_channel = 0;
    std::shared_ptr<const voxel::LayerEvaluator> shape;  // where only "inside" is read
    std::shared_ptr<const voxel::FieldEvaluator> fields;
  };
  StageInput(std::vector<design::StageChannel> channels, std::vector<Evaluator> evaluators, bool is_zero_outside)
      : channels_(std::move(channels)), evaluators_(std::move(evaluators)), is_zero_outside_(is_zero_outside) {}

  const std::vector<design::StageChannel>& channels() const { return channels_; }
  // Are all values 0 outside of the solids?
  bool is_zero_outside() const { return is_zero_outside_; }
  // No value depends on the box. Throws Cancelled soon after it is asked to stop.
  design::StageValues values(const IndexBox& box, const StopFlag* stop) const;

 private:
  std::vector<design::StageChannel> channels_;
  std::vector<Evaluator> evaluators_;
  bool is_zero_outside_ = true;
};

// Makes programs of the fields that a stage reads. `job` has the scale, the lattice and the stages of the solids' own
// space, and their materials. Throws Error when a solid's program would be too large.
using MakeStageInput = StageInput (*)(const design::Design& job, const std::vector<design::StageRead>& reads,
                                      const voxel::Lattice& lattice);

}  // namespace ombre::compile
