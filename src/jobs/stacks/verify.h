// Verifies a stack, by itself and with its design.
#pragma once

#include <optional>

#include "jobs/stacks/design_checks.h"

namespace ombre::compile {

struct Verification {
  std::string program;  // that wrote the stack
  int64_t layer_count = 0;
  StackCheck stack;
  std::optional<DesignCheck> design;

  Findings findings() const;                   // of both, and of journals
  std::vector<std::string> unchecked() const;  // of both
  Findings journals;
};

// Verifies the stack in a folder, with a design unless it is null. Returns nothing, and adds diagnostics, if the design
// is wrong. `program` is this one. Throws Error and Cancelled.
std::optional<Verification> verify(const std::string& folder, const LoadedPtr& design, const SampleChoice& choice,
                                   const std::string& program, const CheckWork& work, Diagnostics& diagnostics);

}  // namespace ombre::compile
