// Mathematical expressions in strings: parsed, checked, printed, lowered to fields.
//
// The dialect is the one that designs know from ExprTk: see docs/user/expressions.md.
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

// Gives the field of a variable, or nothing if it has no such variable.
using Variables = std::function<std::optional<program::Field>(std::string_view name)>;

// A handle: copies share what was parsed, and so do formulas of one text that a thread parses in a row.
class Expression {
 public:
  // constant + slope * variable.
  struct Linear {
    double constant = 0, slope = 0;
    bool operator==(const Linear&) const = default;
  };

  // Nothing, and diagnostics that point into the string, when it is wrong. `where` is the range of
  // the string's characters in its file, if they stand there literally. Unknown functions and wrong
  // argument counts are found here, unknown variables by `check_variables`.
  static std::optional<Expression> parse(const std::string& text, const SourceRange& where, Diagnostics& diagnostics);
  static Expression constant(double value);
  // The first channel of a source at the point, as a function of the host program gives it. Its text tells
  // functions apart, but cannot be parsed.
  static Expression of_source(const program::SourceField& source);
  static Expression of_input(InputPtr input);
  // Makes an expression of smaller ones. The function must exist and take so many arguments.
  static Expression negate(const Expression& a);
  static Expression logical_not(const Expression& a);
  static Expression binary(Binary binary, const Expression& a, const Expression& b);
  static Expression call(const std::string& function, const std::vector<Expression>& arguments);
  static Expression conditional(const Expression& condition, const Expression& yes, const Expression& no);
  // Replaces some variables by other expressions. `other` gets the variable's name and the bytes of its text.
  using Substitutes = std::function<std::optional<Expression>(const Node& variable)>;
  Expression with_substitutes(const Substitutes& other) const;

  // Every variable must be among `known`; `text` and `where` as it was parsed.
  bool check_variables(const std::vector<std::string>& known, const std::string& text, const SourceRange& where,
                       Diagnostics& diagnostics) const;
  // The place of a variable; `text` and `where` as it was parsed.
  static SourceRange place(const Node& variable, const std::string& text, const SourceRange& where);
  bool uses(std::string_view variable) const;
  const program::SourceField& source() const { return root().source; }  // null: it is a formula
  // The number, if the expression has no variables.
  std::optional<double> constant_value() const;
  // As it is written: sums, and products and quotients with constants. Nothing where it depends on other variables.
  std::optional<Linear> linear_in(std::string_view variable) const;

  // Spelt in one way: what is the same but for spaces, case and brackets prints the same. Inputs are v, or v1, v2, ...
  const std::string& text() const { return parsed_->canonical; }
  // The same for people, with the inputs' own names.
  std::string text_with_names() const;
  // Each once, in the order in which they first occur.
  const std::vector<InputPtr>& inputs() const { return parsed_->inputs; }
  std::string input_name(size_t i) const;  // in text()
  // Numbers, variables, operators and so on; 0 for a formula that was read.
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
  explicit Expression(NodePtr root);  // which may hold inputs
  const Node& root() const { return *parsed_->root; }

  std::shared_ptr<const Parsed> parsed_;
};

// x y z rho phic r theta phis ci cj ck: what every expression knows.
const std::vector<std::string>& coordinate_names();
// ci cj ck: the cell's indices, known below what repeats space.
const std::array<std::string_view, 3>& cell_names();
// A table of the functions, for the documentation: name, arguments, meaning.
struct FunctionInfo {
  std::string_view name, arguments, meaning;
};
std::vector<FunctionInfo> function_table();

}  // namespace ombre::expr
