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

struct VerifyRequest {
  std::string stack;    // folder or archive
  std::string layers;   // a value of --layers; empty: all
  LoadedPtr design;     // null: the stack is verified by itself
  SampleChoice choice;  // voxels that are compared with the design
  std::string program;  // this one
};

// Verifies a stack. Returns nothing, and adds diagnostics, if the design is wrong. Throws Error, Cancelled, and
// options::WrongValue if the stack has none of the layers.
std::optional<Verification> verify(const VerifyRequest& request, const CheckWork& work, Diagnostics& diagnostics);

}  // namespace ombre::compile
