// Who computes the values of voxels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ombre::voxel {

// Who computes values. Batches are floats, the reference is in double precision; voxels within rounding
// of a boundary may differ.
enum class Evaluator { batch, reference };
// In the order of the values.
const std::vector<std::string>& evaluator_names();

struct EvaluatorOptions {
  Evaluator evaluator = Evaluator::batch;
  // These decide no voxel, only speed:
  std::string instruction_set;   // one of instruction_sets(); empty: the best
  bool prune = true;             // ask intervals about tiles
  bool write_parts_out = false;  // many parts op by op, as the reference has them
  int64_t leaf_width = 0;        // of tiles that are not cut further; 0: what suits
};

// The names of what batches can run on here, best first; none without hardware multiply-add.
std::vector<std::string> instruction_sets();

}  // namespace ombre::voxel
