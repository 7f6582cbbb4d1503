// The calls and variables of a script as a graph: which call stands in which, and which variables they use.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/text/diagnostic.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/dialect.h"

namespace ombre::lang {

struct GraphArgument {
  std::string name;  // empty if the call gives it by its position
  const ast::Expr* value = nullptr;
  ast::Span whole;  // from the name to the end of the value
};

struct GraphItem {
  enum class Kind : uint8_t {
    call,      // a statement that makes a solid
    variable,  // an assignment
    value,     // a call in an expression
    group      // a loop, a condition, a module and so on
  };

  Kind kind = Kind::call;
  std::string callee;                    // the name that is called, or the word of a group; empty for other expressions
  std::string variable;                  // the name of a variable or a module
  std::optional<size_t> parent;          // the item in whose braces, or in whose arguments, it stands
  size_t argument = 0;                   // of a value: the number of the parent's argument
  std::string locked_by;                 // what makes it, such as "a loop"; empty if it can be edited
  ast::Span locked_at;                   // the begin of what makes it
  ast::Span span;                        // of the statement without modifiers, or of the expression
  std::vector<GraphArgument> arguments;  // a variable that is no call has one: its value

  const ast::Statement* statement = nullptr;  // null for a value
  const ast::Block* container = nullptr;      // the braces of the statement; null at the top level
  const ast::Expr* expression = nullptr;      // of a value, and of a variable

  bool is_locked() const { return !locked_by.empty(); }
};

// A name in an expression, or in a formula in a string.
struct Mention {
  std::string name;
  ast::Span span;
  std::optional<size_t> target;   // the variable that it means, if it is one of the graph
  size_t item = 0, argument = 0;  // where it stands; `item` is no_item outside of items
  std::string output;             // the member that is read, as in c.edges
  bool is_whole = false;          // it is all that the argument has
  bool is_local = false;          // it means a parameter, or a variable of a loop or of let()
  bool is_bare_text = false;      // a string with nothing but the name, which may be a text or a formula
};

struct GraphDefinition {
  std::string name;
  bool is_module = false;
  const std::vector<ast::Parameter>* parameters = nullptr;
  ast::Span span;
};

class ScriptGraph {
 public:
  static constexpr size_t most_items = 3000;
  static constexpr size_t no_item = SIZE_MAX;

  // Returns nothing if the script has mistakes, which are added to the diagnostics.
  static std::optional<ScriptGraph> read(const SourcePtr& source, Dialect dialect, Diagnostics& diagnostics);
  std::optional<ScriptGraph> read_again(const SourcePtr& source, Diagnostics& diagnostics) const {
    return read(source, dialect_, diagnostics);
  }

  const SourcePtr& source() const { return *file_.source; }
  std::string_view text() const { return source()->text(); }
  std::string_view text(const ast::Span& span) const { return text().substr(span.begin, span.end - span.begin); }
  int line(const ast::Span& span) const { return source()->place(span.begin).line; }
  const ast::File& file() const { return file_; }
  Dialect dialect() const { return dialect_; }

  // The items in the order of the text, each before those within it.
  const std::vector<GraphItem>& items() const { return items_; }
  const std::vector<Mention>& mentions() const { return mentions_; }
  const std::vector<GraphDefinition>& definitions() const { return definitions_; }
  // True if the script has more items than are listed.
  bool is_cut() const { return is_cut_; }

  // Returns the number of the first item after an item and all that is within it.
  size_t end_of(size_t item) const;
  bool is_within(size_t item, size_t ancestor) const;
  // Returns the item, or its ancestor, that is a statement.
  size_t statement_of(size_t item) const;
  // Returns the variable that a name means in the braces of an item, or at the top level.
  std::optional<size_t> find(const std::string& name, std::optional<size_t> scope) const;

 private:
  friend class GraphReader;
  ast::File file_;
  Dialect dialect_ = Dialect::vcad;
  std::vector<GraphItem> items_;
  std::vector<Mention> mentions_;
  std::vector<GraphDefinition> definitions_;
  std::unordered_map<std::string, std::vector<size_t>> variables_;  // items that are variables, by their names
  bool is_cut_ = false;
};

}  // namespace ombre::lang
