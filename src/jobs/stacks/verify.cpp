#include "jobs/stacks/verify.h"

#include "jobs/slice/slice_choices.h"

#include <iterator>

namespace ombre::compile {

Findings Verification::findings() const {
  Findings all = journals;
  all.insert(all.end(), stack.findings.begin(), stack.findings.end());
  if (design) all.insert(all.end(), design->findings.begin(), design->findings.end());
  return all;
}

std::vector<std::string> Verification::unchecked() const {
  std::vector<std::string> all = stack.unchecked;
  if (design)
    all.insert(all.end(), design->unchecked.begin(), design->unchecked.end());
  else
    all.emplace_back("without a design, voxels are compared with nothing but their counts");
  return all;
}

std::optional<Verification> verify(const VerifyRequest& request, const CheckWork& work, Diagnostics& diagnostics) {
  Verification result;
  const Stack stack = open_stack(request.stack, result.journals);
  const LayerReader reader(stack.request());
  result.program = stack.request().program;
  result.layer_count = stack.layer_count();
  const LayerRange all{0, stack.layer_count()}, layers = chosen_layers(request.layers, all.end).value_or(all);
  const CheckWork fits = fitting(work, stack.request().lattice);
  result.stack = check_stack(stack, layers, reader, fits);
  if (!request.design) return result;
  if (!stack.request().corrections.empty()) {
    result.design.emplace().unchecked.emplace_back(
        "the job has corrections, so its voxels are not compared with those of the design");
    return result;
  }
  result.design = check_design(stack, reader, request.design, layers, request.choice, fits, diagnostics);
  if (!result.design) return std::nullopt;
  if (result.program != request.program)
    result.design->unchecked.push_back("the stack is by " + result.program + ", and this is " + request.program +
                                       ", which may give other voxels");
  return result;
}

}  // namespace ombre::compile
