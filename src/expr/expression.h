// Mathematical expressions in strings: parsing, checks, printing, and lowering to fields.
//
// The syntax follows ExprTk; docs/user/expressions.md describes it.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/text/diagnostic.h"
#include "expr/expression_tree.h"
#include "program/field.h"

namespace ombre::expr {

// Returns the field of a variable, or nothing if there is no such variable.
using Variables = std::function<std::optional<program::Field>(std::string_view name)>;

// A parsed expression. Copies share the tree, and a thread that parses the same text again gets a cached one.
class Expression {
 public:
  // The linear function constant + slope * variable.
  struct Linear {
    double constant = 0, slope = 0;
    bool operator==(const Linear&) const = default;
  };

  // Returns nothing and adds diagnostics that point into the string if it is wrong. `where` is the range of the
  // string's characters in its file, if they occur there literally. Unknown functions and wrong numbers of arguments
  // are reported here, unknown variables by `check_variables`.
  static std::optional<Expression> parse(const std::string& text, const SourceRange& where, Diagnostics& diagnostics);
  static Expression constant(double value);
  // Returns an expression for the first channel of a source at the point, such as a function of the host program. Its
  // text identifies the function but cannot be parsed.
  static Expression of_source(const program::SourceField& source);
  static Expression of_input(InputPtr input);
  // Combines expressions. The function must exist and take that number of arguments.
  static Expression negate(const Expression& a);
  static Expression logical_not(const Expression& a);
  static Expression binary(Binary binary, const Expression& a, const Expression& b);
  static Expression call(const std::string& function, const std::vector<Expression>& arguments);
  static Expression conditional(const Expression& condition, const Expression& yes, const Expression& no);
  // Replaces some variables by other expressions. `other` gets the node of a variable, with its name and the range of
  // its text.
  using Substitutes = std::function<std::optional<Expression>(const Node& variable)>;
  Expression with_substitutes(const Substitutes& other) const;

  // Returns false and adds a diagnostic unless every variable is among `known`. `text` and `where` are those given to
  // parse().
  bool check_variables(const std::vector<std::string>& known, const std::string& text, const SourceRange& where,
                       Diagnostics& diagnostics) const;
  // Returns the range of a variable. `text` and `where` are those given to parse().
  static SourceRange place(const Node& variable, const std::string& text, const SourceRange& where);
  bool uses(std::string_view variable) const;
  const program::SourceField& source() const { return root().source; }  // null if it is a formula
  // Returns the number if the expression has no variables, else nothing.
  std::optional<double> constant_value() const;
  // Returns the linear form of an expression that is written as sums, and as products and quotients with constants.
  // Returns nothing if it has another form or depends on other variables.
  std::optional<Linear> linear_in(std::string_view variable) const;

  // Canonical text: expressions that differ only in spaces, case or brackets have the same text. Inputs are named v, or
  // v1, v2, ...
  const std::string& text() const { return parsed_->canonical; }
  // Returns the canonical text with the inputs' own names, for people.
  std::string text_with_names() const;
  // Inputs in the order of their first occurrence, each once.
  const std::vector<InputPtr>& inputs() const { return parsed_->inputs; }
  std::string input_name(size_t i) const;  // name of input i in text()
  // Number of nodes of the tree; 0 for a parsed formula.
  size_t size() const { return parsed_->size; }

  program::Field lower(const program::Point& p, const Variables& extra) const;

  bool operator==(const Expression& other) const;

 private:
  struct Parsed {
    NodePtr root;
    std::string canonical;
    std::vector<InputPtr> inputs = {};
    size_t size = 0;
  };
  Expression(NodePtr root, std::string canonical)
      : parsed_(std::make_shared<const Parsed>(Parsed{std::move(root), std::move(canonical)})) {}
  explicit Expression(NodePtr root);  // the tree may contain inputs
  const Node& root() const { return *parsed_->root; }

  std::shared_ptr<const Parsed> parsed_;
};

// Coordinates that every expression may use: x y z rho phic r theta phis ci cj ck.
const std::vector<std::string>& coordinate_names();
// Indices of the cell: ci cj ck, defined below nodes that repeat space.
const std::array<std::string_view, 3>& cell_names();
// A function as the documentation lists it: name, arguments, meaning.
struct FunctionInfo {
  std::string_view name, arguments, meaning;
};
std::vector<FunctionInfo> function_table();

}  // namespace ombre::expr
