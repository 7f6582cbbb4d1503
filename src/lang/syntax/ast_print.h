// Prints a syntax tree as a script.
#pragma once

#include <string>
#include <vector>

#include "lang/syntax/ast.h"

namespace ombre::lang {

// Returns a text that is parsed to the same tree: print(parse(print(f))) is print(f).
std::string print(const ast::File& file);
// Returns one line, for messages.
std::string print(const ast::Expr& expression);

// How a language writes expressions.
struct SyntaxStyle {
  std::string (*number)(double);
  std::string (*literal)(const std::string&);
  bool has_all_parentheses;  // around each operator and each element of a loop, also where they are not needed
  const char* gap;           // between the signs of a head: "for (" or "for("
};

// Prints expressions, and the heads of statements.
class SyntaxPrinter {
 public:
  explicit SyntaxPrinter(const SyntaxStyle& style) : style_(style) {}

  std::string text;

  // Puts the expression in parentheses if it binds more loosely than its place requires.
  void print(const ast::Expr& expr, int place = 0);

 protected:
  void assignment(const ast::Assign& assign);
  void definition(const ast::FunctionDef& function);
  void head(const ast::ModuleDef& module);
  void head(const ast::CallStatement& call);

 private:
  void bare(const ast::Expr& expr);
  void range(const ast::Range& range);
  void list(const ast::List& list);
  void chain(const ast::Chain& chain);
  void power(const ast::Power& power);
  void conditional(const ast::Conditional& conditional);
  void prefix(const ast::Prefix& prefix);
  void generator(const ast::Expr& expr);
  void loop(const ast::GenerateLoop& loop);
  void choice(const ast::GenerateIf& choice);
  void after_head(const ast::Expr& element, bool in_parentheses);
  void list_of(const std::vector<ast::Argument>& list);
  void arguments(const std::vector<ast::Argument>& list);
  void parameters(const std::vector<ast::Parameter>& list);

  const SyntaxStyle& style_;
};

}  // namespace ombre::lang
