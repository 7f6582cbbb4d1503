// The evaluators of voxels and their options.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ombre::voxel {

// The way in which values are computed. Batches use floats, the reference uses double precision. Voxels within rounding
// of a boundary may differ.
enum class Evaluator { batch, reference };
// Returns the names, in the order of the enumeration.
const std::vector<std::string>& evaluator_names();

struct EvaluatorOptions {
  Evaluator evaluator = Evaluator::batch;
  // These options affect only speed, no voxel.
  std::string instruction_set;   // one of instruction_sets(); empty for the best one
  bool prune = true;             // evaluates intervals over tiles
  bool write_parts_out = false;  // replaces many parts by their code, as the reference does
  int64_t leaf_width = 0;        // width of tiles that are not divided further; 0 chooses one
};

// Returns the names of the instruction sets that batches can use here, the best first. Empty without hardware
// multiply-add.
std::vector<std::string> instruction_sets();

}  // namespace ombre::voxel
