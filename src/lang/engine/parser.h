// Parses a script into its tree.
#pragma once

#include "base/text/diagnostic.h"
#include "lang/engine/ast.h"
#include "lang/engine/dialect.h"

namespace ombre::lang {

// Parentheses, brackets, braces and operators inside each other; deeper is a diagnostic.
constexpr int deepest_nesting = 200;

// Always gives a tree, of what could be read.
ast::File parse(const SourcePtr& source, Diagnostics& diagnostics, Dialect dialect = Dialect::vcad);
// The same for evaluation: the calls in long lists are deferred. Files that are evaluated together share a
// table of names.
ast::File parse_deferred(const SourcePtr& source, std::shared_ptr<Names> names, Dialect dialect,
                         Diagnostics& diagnostics);
// The call itself, without its modifiers. The text was read before without mistakes.
ast::StatementPtr read(const ast::Deferred& call, Names& names, Dialect dialect = Dialect::vcad);

// About variables that one file gives several values in one scope.
void warn_of_replaced(const ast::Plan& plan, Diagnostics& diagnostics);

}  // namespace ombre::lang
