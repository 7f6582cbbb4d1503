#include "voxel/evaluator.h"

#include "eval/batch/kernels.h"

namespace ombre::voxel {

const std::vector<std::string>& evaluator_names() {
  static const std::vector<std::string> names{"batch", "reference"};
  return names;
}

std::vector<std::string> instruction_sets() {
  std::vector<std::string> names;
  for (const eval::KernelSet& set : eval::kernel_sets()) names.emplace_back(set.name);
  return names;
}

}  // namespace ombre::voxel
