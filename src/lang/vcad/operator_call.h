// Calls a module or function of a library with values of a host program, such as Python.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lang/engine/run_options.h"
#include "lang/vcad/vcad.h"

namespace ombre::lang {

struct HostCall {
  std::string library;  // "ombre/cellular.vcad"
  std::string name;
  bool is_module = false;
  std::vector<std::pair<std::string, Data>> arguments;  // an empty name if one is given by position
  std::vector<design::NodePtr> children;
};

// The solids of a module, joined, or the value of a function.
struct HostResult {
  design::NodePtr solid;
  Data value;
};

// Returns nothing, and adds diagnostics, if the call is wrong.
std::optional<HostResult> call_operator(const HostCall& call, const design::Registry& registry,
                                        const design::MaterialTable& materials, design::SourceLoader* loader,
                                        const Options& options, const SourceRange& where, Diagnostics& diagnostics);

}  // namespace ombre::lang
