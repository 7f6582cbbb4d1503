// What names mean: a language engine asks a vocabulary for nodes and constants.
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

// What a call makes. Only the vocabulary that made it knows its type; the engine keeps it and passes it on.
using Product = std::shared_ptr<const void>;

struct Argument {
  std::string name;        // empty when positional
  SourceRange name_where;  // of the name, if there is one
  Data value;              // value.where is the range of the argument's expression, or of a plain string's characters
};

// One call of a node, all values known.
struct Invocation {
  std::string name;   // as written
  SourceRange where;  // of the name
  SourceRange whole;  // from the name to the closing parenthesis
  std::vector<Argument> arguments;
  std::vector<Product> children;  // null results are left out
  // The children that one statement of the braces gave stand together; each group ends before these
  // positions. Loops, modules and conditions may give several, or none.
  std::vector<size_t> group_ends;
  enum class Braces : uint8_t { none, empty, filled } braces = Braces::none;  // filled also by a single child without
  double facets = 0;                                                          // $fn there; 0: nobody set it
  bool has_own_facets = false;                                                // $fn is one of the arguments
  std::string wrong_facets;              // what $fn is where it is no number: "a string"
  bool has_wrong_children = false;       // there were mistakes in the braces, and they were reported
  bool is_top_level = false;             // a statement of the main file, outside of any call
  std::vector<SourceRange> called_from;  // user module calls around it, innermost first, at most 8
  // The script's variable of that name there, if it is a number or an object. Only while the call is made.
  std::function<std::optional<Data>(const std::string& name)> variable;
};

class Vocabulary {
 public:
  virtual ~Vocabulary() = default;
  virtual bool knows(std::string_view name) const = 0;
  virtual std::vector<std::string> names() const = 0;                     // for suggestions
  virtual std::string hint(std::string_view unknown) const = 0;           // what to write for it; empty if unknown here
  virtual std::optional<Data> constant(std::string_view name) const = 0;  // materials, axes
  virtual std::vector<std::string> constants() const = 0;                 // for suggestions
  // Null when the call is wrong (and then diagnostics were added) or gives nothing.
  virtual Product make(Invocation call, Diagnostics& diagnostics) = 0;
  // Names that are called in expressions, and what such a call gives; nothing when it is wrong, and then diagnostics
  // were added.
  virtual bool gives_value(std::string_view) const { return false; }
  virtual std::vector<std::string> value_names() const { return {}; }
  virtual std::optional<Value> value(Invocation, Diagnostics&, Meter&) { return std::nullopt; }
};

}  // namespace ombre::lang
