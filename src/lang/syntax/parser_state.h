// The parser class, shared by its two parts for statements and expressions.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/temporary.h"
#include "lang/syntax/ast.h"
#include "lang/syntax/lexer.h"
#include "lang/syntax/parser.h"

namespace ombre::lang {

// Thrown to abandon the current statement after a diagnostic was recorded.
struct SyntaxError {};

class Parser {
 public:
  // Starts reading at `begin`. Errors in tokens are added to `lexical`, all others to `diagnostics`.
  Parser(const SourcePtr* source, uint32_t begin, Dialect dialect, Names& names, Diagnostics& lexical,
         Diagnostics& diagnostics)
      : source_(source),
        text_((*source)->text()),
        dialect_(dialect),
        names_(names),
        tokens_(*source, begin, dialect, lexical),
        diagnostics_(diagnostics) {}

  // In long lists of statements, keeps only the positions of calls.
  void defer_calls() { defers_ = true; }
  std::vector<ast::StatementPtr> file();
  ast::StatementPtr statement();

 private:
  // Counts a level of nesting for as long as the result lives.
  Temporary<int> deeper();

  // Functions that read tokens.
  Token token(size_t ahead = 0) { return tokens_.ahead(ahead); }
  TokenKind kind(size_t ahead = 0) { return token(ahead).kind; }
  std::string_view text(const Token& token) const { return text_.substr(token.begin, token.end - token.begin); }
  bool at(TokenKind wanted) { return kind() == wanted; }
  bool at_word(std::string_view word, size_t ahead = 0);
  bool is_name(size_t ahead = 0);  // a name that is not a reserved word
  bool accept(TokenKind wanted);
  void take() {
    if (kind() != TokenKind::end) tokens_.take();
  }
  void expect(TokenKind wanted, const char* what);
  ast::Span span(const Token& token) const { return {source_, token.begin, token.end}; }
  ast::Span since(uint32_t begin) const { return {source_, begin, std::max(begin, last_end())}; }
  uint32_t last_end() const { return tokens_.last_end(); }
  std::string found();
  [[noreturn]] void fail(ast::Span where, std::string message, Phrase hint = {});
  [[noreturn]] void fail_here(const std::string& expected, Phrase hint = {});
  ast::Name name(const char* what);
  ast::Name name_at(ast::Span where, std::string_view text);

  // Functions that read statements.
  void statements(std::vector<ast::StatementPtr>& into, bool inside_braces);
  void resynchronise();
  void defer(ast::StatementPtr& statement) const;
  ast::StatementPtr include();
  ast::StatementPtr group();
  ast::StatementPtr assignment();
  template <class Definition>
  std::unique_ptr<Definition> definition(const char* what);
  ast::StatementPtr function_definition();
  ast::StatementPtr module_definition();
  ast::StatementPtr instantiation();
  ast::StatementPtr condition(ast::Modifiers modifiers);
  ast::StatementPtr call(ast::Modifiers modifiers);
  ast::Name call_name();
  size_t hyphenated_tokens();
  void block(ast::Block& into, const char* owner);
  void braces(ast::Block& into);
  void finish(ast::Block& block);
  void end_of_statement(const char* after);
  bool at_last_of_braces() { return dialect_ == Dialect::vcad && at(TokenKind::right_brace); }
  static ast::Statement::Kind call_kind(std::string_view name);

  // Functions that read expressions.
  ast::ExprPtr expression();
  ast::ExprPtr conditional();
  ast::ExprPtr chain(int precedence);
  ast::ExprPtr links(int precedence, ast::ExprPtr first);
  ast::ExprPtr unary();
  ast::ExprPtr power();
  ast::ExprPtr postfix();
  ast::ExprPtr primary();
  ast::ExprPtr parenthesised();
  ast::ExprPtr bracketed();
  ast::ExprPtr element();
  ast::ExprPtr generator();
  ast::ExprPtr generate_for();
  ast::ExprPtr function_literal();
  ast::ExprPtr prefix(ast::PrefixKind which, bool inside_list);
  ast::ExprPtr number();
  ast::ExprPtr string();
  bool at_generator(size_t ahead = 0);
  bool at_parenthesised_generator();
  bool at_expression_end();
  void arguments(std::vector<ast::Argument>& into);  // including both parentheses
  void skip_empty_places();
  void arguments_until(TokenKind close, std::vector<ast::Argument>& into);
  void named_arguments(std::vector<ast::Argument>& into, const char* owner, TokenKind close);
  void parameters(std::vector<ast::Parameter>& into);

  const SourcePtr* source_;
  std::string_view text_;
  Dialect dialect_;
  Names& names_;
  Tokens tokens_;
  Diagnostics& diagnostics_;
  int depth_ = 0;
  bool defers_ = false;
  bool is_repeated_ = false;  // within a loop or module, whose calls may be evaluated many times
};

}  // namespace ombre::lang
