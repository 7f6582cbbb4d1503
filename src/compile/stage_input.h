// Evaluates the fields that a stage reads, on its lattice.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/diagnostic.h"
#include "base/error.h"
#include "design/design.h"
#include "voxel/fields.h"
#include "voxel/layers.h"

namespace ombre::compile {

// For stages that cannot be evaluated: all messages, with the code and the values of the first error.
Error error_of(const Diagnostics& diagnostics);

// Thread-safe once it is built.
class StageInput {
 public:
  // `job` has the scale, the lattice and the stages of the solids' own space, and their materials. Throws Error when a
  // solid's program would be too large.
  StageInput(const design::Design& job, const std::vector<design::StageRead>& reads, const voxel::Lattice& lattice);

  const std::vector<design::StageChannel>& channels() const { return channels_; }
  // Are all values 0 outside of the solids?
  bool is_zero_outside() const { return is_zero_outside_; }
  // No value depends on the box. Throws Cancelled soon after it is asked to stop.
  design::StageValues values(const IndexBox& box, const StopFlag* stop) const;

 private:
  // Evaluates what is read of one solid, for one or several channels.
  struct Evaluator {
    size_t first_channel = 0;
    std::shared_ptr<const voxel::LayerEvaluator> shape;  // where only "inside" is read
    std::shared_ptr<const voxel::FieldEvaluator> fields;
  };
  void add(const design::Design& job, const design::StageRead& read, const voxel::Lattice& lattice, size_t number);
  void add_shape(const design::Design& solid, const voxel::Lattice& lattice, Evaluator& evaluator, size_t number);
  void add_fields(const design::Design& solid, const design::StageRead& read, const voxel::Lattice& lattice,
                  Evaluator& evaluator, size_t number);

  std::vector<design::StageChannel> channels_;
  std::vector<Evaluator> evaluators_;
  bool is_zero_outside_ = true;
};

}  // namespace ombre::compile
