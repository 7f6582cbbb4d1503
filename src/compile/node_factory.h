// Nodes made one by one by a program, as the calls of a .vcad file make them.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compile/mesh_loader.h"
#include "design/design.h"

namespace ombre::compile {

// Thread-safe, but for what the materials' owner does.
class NodeFactory {
 public:
  explicit NodeFactory(design::MaterialTable materials) : materials_(std::move(materials)) {}

  const design::MaterialTable& materials() const { return materials_; }

  // An argument has a name, or an empty one when it is given by position. Null, and diagnostics, when the call is
  // wrong. Throws Error for files that cannot be read.
  using Arguments = std::vector<std::pair<std::string, Data>>;
  design::NodePtr make(std::string_view type, Arguments arguments, std::vector<design::NodePtr> inputs,
                       const SourceRange& where, Diagnostics& diagnostics);

 private:
  design::MaterialTable materials_;
  MeshLoader loader_;
};

}  // namespace ombre::compile
