// The context in which parameters of nodes are read.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "design/materials.h"

namespace ombre::design {

class Node;
using NodePtr = std::shared_ptr<const Node>;
class SourceLoader;

// Returns the value that formulas know by this name, or nothing.
using NamedValues = std::function<std::optional<Data>(const std::string& name)>;

// The context in which a parameter is read.
struct Reader {
  const MaterialTable& materials;
  Diagnostics& diagnostics;
  SourceLoader* loader = nullptr;
  SourceRange where;            // position of the call, for messages about missing values
  std::string_view node, name;  // node and parameter that are read
  const NamedValues* names = nullptr;
  std::vector<NodePtr>* values = nullptr;        // collects the nodes whose outputs the parameter holds
  const std::vector<NodePtr>* inputs = nullptr;  // the node's inputs, whose attributes expressions may use

  void keep(const NodePtr& value) const;
  // Adds an error at the call. Returns false.
  bool refuse(const std::string& message, const Phrase& hint = {}) const;
  bool fail(const Data& data, const std::string& expected, const Phrase& hint = {},
            Code code = Code::parameter_type) const;
};

}  // namespace ombre::design
