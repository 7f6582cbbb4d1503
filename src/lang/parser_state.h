// The parser's insides, shared by its two halves: statements and expressions.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "lang/ast.h"
#include "lang/lexer.h"
#include "lang/parser.h"

namespace ombre::lang {

// Ends the statement being read; its diagnostic was recorded.
struct SyntaxError {};

class Parser {
 public:
  Parser(const SourcePtr* source, Names& names, Tokens tokens, Diagnostics& diagnostics)
      : source_(source),
        text_((*source)->text()),
        names_(names),
        tokens_(std::move(tokens)),
        diagnostics_(diagnostics) {}

  std::vector<ast::StatementPtr> file();

 private:
  // One level of nesting, for as long as it lives.
  class Level {
   public:
    explicit Level(Parser& parser);
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  // --- tokens
  const Token& token(size_t ahead = 0) const;
  TokenKind kind(size_t ahead = 0) const { return token(ahead).kind; }
  std::string_view text(const Token& token) const { return text_.substr(token.begin, token.end - token.begin); }
  bool at(TokenKind wanted) const { return kind() == wanted; }
  bool at_word(std::string_view word, size_t ahead = 0) const;
  bool is_name(size_t ahead = 0) const;  // a name that is no reserved word
  bool accept(TokenKind wanted);
  void take() {
    if (kind() != TokenKind::end) ++next_;
  }
  void expect(TokenKind wanted, const char* what);
  ast::Span span(const Token& token) const { return {source_, token.begin, token.end}; }
  ast::Span since(uint32_t begin) const { return {source_, begin, std::max(begin, last_end())}; }
  uint32_t last_end() const { return next_ == 0 ? 0 : tokens_.list[next_ - 1].end; }
  std::string found() const;
  [[noreturn]] void fail(ast::Span where, std::string message, std::string hint = "");
  [[noreturn]] void fail_here(const std::string& expected, std::string hint = "");
  ast::Name name(const char* what);
  ast::Name name_at(ast::Span where, std::string_view text);

  // --- statements
  void statements(std::vector<ast::StatementPtr>& into, bool inside_braces);
  void resynchronise();
  ast::StatementPtr statement();
  ast::StatementPtr include();
  ast::StatementPtr group();
  ast::StatementPtr assignment();
  ast::StatementPtr function_definition();
  ast::StatementPtr module_definition();
  ast::StatementPtr instantiation();
  ast::StatementPtr condition(std::string modifiers);
  ast::StatementPtr call(std::string modifiers);
  ast::Name call_name();
  size_t hyphenated_tokens() const;
  void block(ast::Block& into, const char* owner);
  void braces(ast::Block& into);
  void finish(ast::Block& block);
  void end_of_statement(const char* after);
  static ast::Statement::Kind call_kind(std::string_view name);

  // --- expressions
  ast::ExprPtr expression();
  ast::ExprPtr conditional();
  ast::ExprPtr chain(int precedence);
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
  bool at_generator(size_t ahead = 0) const;
  bool at_parenthesised_generator() const;
  bool at_expression_end() const;
  void arguments(std::vector<ast::Argument>& into);  // with both parentheses
  void arguments_until(TokenKind close, std::vector<ast::Argument>& into);
  void named_arguments(std::vector<ast::Argument>& into, const char* owner, TokenKind close);
  void parameters(std::vector<ast::Parameter>& into);

  const SourcePtr* source_;
  std::string_view text_;
  Names& names_;
  Tokens tokens_;
  Diagnostics& diagnostics_;
  size_t next_ = 0;
  int depth_ = 0;
};

}  // namespace ombre::lang
