// Text -> tree, by precedence climbing.
#pragma once

#include <memory>

#include "expr/expression.h"

namespace ombre::expr {

// Null, and one diagnostic, when the text is wrong. `where` covers the text's characters.
std::shared_ptr<const Node> parse_tree(std::string_view text, const SourceRange& where, Diagnostics& diagnostics);

// Spelt in one way, with no more brackets than are needed.
std::string print_tree(const Node& node);

}  // namespace ombre::expr
