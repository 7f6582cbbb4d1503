// Makes single nodes for a program, as the calls of a .vcad file make them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "design/design.h"
#include "lang/vcad/operator_call.h"
#include "load/design_sources.h"

namespace ombre::compile {

// A thread-safe factory; the owner of the materials must guard changes to them.
class NodeFactory {
 public:
  NodeFactory(design::MaterialTable materials, std::shared_ptr<sources::SourceCache> cache)
      : materials_(std::move(materials)), cache_(std::move(cache)), loader_(*cache_) {}

  const design::MaterialTable& materials() const { return materials_; }

  // Makes a node. An argument has a name, or an empty one if it is given by position. Returns null, and adds
  // diagnostics, when the call is wrong. Throws Error for files that cannot be read.
  using Arguments = std::vector<std::pair<std::string, Data>>;
  design::NodePtr make(std::string_view type, Arguments arguments, std::vector<design::NodePtr> inputs,
                       const SourceRange& where, Diagnostics& diagnostics);

  // Calls a module or function of a library, as a design that uses it does.
  std::optional<lang::HostResult> call(const lang::HostCall& call, const SourceRange& where, Diagnostics& diagnostics);

 private:
  design::MaterialTable materials_;
  std::shared_ptr<sources::SourceCache> cache_;
  DesignSources loader_;
};

}  // namespace ombre::compile
