// Text -> tree, by precedence climbing.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/text/diagnostic.h"
#include "expr/expression_tree.h"

namespace ombre::expr {

// Null, and one diagnostic, when the text is wrong. `where` covers the text's characters.
std::shared_ptr<const Node> parse_tree(std::string_view text, const SourceRange& where, Diagnostics& diagnostics);

// The name of an input in a text.
using InputNames = std::function<std::string(const Input& input)>;

// Spelt in one way, with no more brackets than are needed.
std::string print_tree(const Node& node, const InputNames& names = nullptr);

}  // namespace ombre::expr
