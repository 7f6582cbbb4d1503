// Parses a script into its syntax tree.
#pragma once

#include "base/text/diagnostic.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/dialect.h"

namespace ombre::lang {

// Greatest depth of nested parentheses, brackets, braces and operators. Deeper nesting gives a diagnostic.
constexpr int deepest_nesting = 200;

// Returns a tree of everything that could be parsed.
ast::File parse(const SourcePtr& source, Diagnostics& diagnostics, Dialect dialect = Dialect::vcad);
// Parses for evaluation: calls in long lists are deferred. Files that are evaluated together share a table of names.
ast::File parse_deferred(const SourcePtr& source, std::shared_ptr<Names> names, Dialect dialect,
                         Diagnostics& diagnostics);
// Reads a deferred call again, without its modifiers. Its text must have been parsed without errors.
ast::StatementPtr read(const ast::Deferred& call, Names& names, Dialect dialect = Dialect::vcad);

// Warns about variables to which one file assigns several values in one scope.
void warn_of_replaced(const ast::Plan& plan, Diagnostics& diagnostics);

}  // namespace ombre::lang
