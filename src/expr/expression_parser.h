// Parser and printer of expression trees; parsing is by precedence climbing.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/text/diagnostic.h"
#include "expr/expression_tree.h"

namespace ombre::expr {

// Returns null and adds one diagnostic if the text is wrong. `where` is the range of the text's characters.
std::shared_ptr<const Node> parse_tree(std::string_view text, const SourceRange& where, Diagnostics& diagnostics);

// Returns the name of an input in a printed text.
using InputNames = std::function<std::string(const Input& input)>;

// Returns the canonical text, without unnecessary brackets.
std::string print_tree(const Node& node, const InputNames& names = nullptr);

}  // namespace ombre::expr
