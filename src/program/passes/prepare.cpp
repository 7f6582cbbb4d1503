#include "program/passes/prepare.h"

#include <array>

#include "program/passes/passes.h"

namespace ombre::program {
namespace {

constexpr Pass sign_only_pass{"sign-only", "Distances of which only the sign counts become what decides it.",
                              [](const Program& program) { return sign_only(program); }};
constexpr Pass fuse_pass{"fuse", "Affine maps and products that are only added become fused multiply-adds.",
                         [](const Program& program) { return fuse(program); }};
constexpr Pass compose_pass{"compose-affine", "Sums that are affine in the inputs are computed from these at once.",
                            compose_affine};

constexpr std::array for_ranges{fuse_pass};
constexpr std::array for_batches{sign_only_pass, fuse_pass};
constexpr std::array for_rays{sign_only_pass, fuse_pass, compose_pass};

}  // namespace

std::span<const Pass> passes_for(Purpose purpose) {
  switch (purpose) {
    case Purpose::ranges:
      return for_ranges;
    case Purpose::batch:
      return for_batches;
    case Purpose::rays:
      return for_rays;
  }
  return {};
}

Program prepare(const Program& program, Purpose purpose,
                const std::function<void(const Pass& pass, const Program& made)>& after) {
  Program made = program;
  for (const Pass& pass : passes_for(purpose)) {
    made = pass.run(made);
    if (after) after(pass, made);
  }
  return made;
}

}  // namespace ombre::program
