// Declarations of operators: modules and functions with a block of comments "///" above them, and a comment behind
// each parameter: "size = 6, // [1:0.5:20] mm: Width of a cell".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/diagnostic.h"
#include "lang/syntax/annotation.h"

namespace ombre::lang {

struct DeclaredParameter : Allowed {
  std::string name;
  std::string type;  // one of port_types(), or empty for any value
  std::string unit, sentence;
  std::string default_text;   // as written; empty if the parameter has no default
  std::optional<Data> value;  // the default, if it is plain
};

struct DeclaredOutput {
  std::string name;  // empty for the only one
  std::string type, unit;
};

struct Declaration {
  std::string name;
  bool is_module = false;
  std::string sentence, category, example, source;
  std::vector<DeclaredParameter> parameters;
  std::vector<DeclaredOutput> outputs;  // of a function
};

// The names of types that parameters and outputs may have.
const std::vector<std::string>& port_types();

// Returns the declaration of a module or function, or nothing if no block stands above it. A type or unit that is not
// known gives a warning.
std::optional<Declaration> read_declaration(const ast::ModuleDef& module, Diagnostics& diagnostics);
std::optional<Declaration> read_declaration(const ast::FunctionDef& function, Diagnostics& diagnostics);

// Returns the declarations of a file, in its order.
std::vector<Declaration> declarations_of(const ast::File& file);

}  // namespace ombre::lang
