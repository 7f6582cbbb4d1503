// The interface through which a language engine makes nodes and constants.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/data.h"
#include "base/text/diagnostic.h"
#include "lang/engine/value.h"

namespace ombre::lang {

// The result of a call. Only the vocabulary knows its type; the engine stores it and passes it on.
using Product = std::shared_ptr<const void>;

struct Argument {
  std::string name;        // empty if positional
  SourceRange name_where;  // range of the name, if there is one
  Data value;              // value.where is the range of the argument's expression, or of a plain string's characters
};

// One call of a node with evaluated arguments.
struct Invocation {
  std::string name;   // name as written
  SourceRange where;  // range of the name
  SourceRange whole;  // range from the name to the closing parenthesis
  std::vector<Argument> arguments;
  std::vector<Product> children;  // products of the children, without null results
  // Position after the last child of each statement in the braces. Loops, modules and conditions may give several
  // children or none.
  std::vector<size_t> group_ends;
  // A single child without braces counts as `filled`.
  enum class Braces : uint8_t { none, empty, filled } braces = Braces::none;
  double facets = 0;                     // value of $fn at the call; 0 if it was not set
  bool has_own_facets = false;           // true if $fn is one of the arguments
  std::string wrong_facets;              // description of $fn if it is not a number: "a string"
  bool has_wrong_children = false;       // true if the braces contained errors, which were reported
  bool is_top_level = false;             // true for a statement of the main file outside any call
  std::vector<SourceRange> called_from;  // the enclosing calls of user modules, innermost first, at most 8
  // Returns the script's variable of that name at the call, if it is a number or an object. Valid only during the call.
  std::function<std::optional<Data>(const std::string& name)> variable;
};

class Vocabulary {
 public:
  virtual ~Vocabulary() = default;
  virtual bool knows(std::string_view name) const = 0;
  virtual std::vector<std::string> names() const = 0;  // all names, for suggestions
  // Returns what to write in place of an unknown name; empty if there is no hint.
  virtual std::string hint(std::string_view unknown) const = 0;
  virtual std::optional<Data> constant(std::string_view name) const = 0;  // materials, axes
  virtual std::vector<std::string> constants() const = 0;                 // all names of constants, for suggestions
  // Returns null if the call gives nothing, or is wrong; then diagnostics were added.
  virtual Product make(Invocation call, Diagnostics& diagnostics) = 0;
  // Calls in expressions: whether a name can be called, the names, and the value of a call. value() returns nothing and
  // adds diagnostics if the call is wrong.
  virtual bool gives_value(std::string_view) const { return false; }
  virtual std::vector<std::string> value_names() const { return {}; }
  virtual std::optional<Value> value(Invocation, Diagnostics&, Meter&) { return std::nullopt; }
  // Returns the value of an expression that stands for the union of nodes.
  virtual std::optional<Value> solid(std::vector<Product>, const SourceRange&, Diagnostics&, Meter&) {
    return std::nullopt;
  }
};

}  // namespace ombre::lang
