// The part of the parser that reads statements.
#include "lang/syntax/parser.h"

#include <algorithm>
#include <array>

#include "base/text/text.h"
#include "lang/syntax/declaration.h"
#include "lang/syntax/parser_state.h"

namespace ombre::lang {

using namespace ast;

namespace {

constexpr std::array<std::string_view, 14> reserved = {"module", "function", "if",      "else", "for",
                                                       "let",    "assert",   "echo",    "each", "true",
                                                       "false",  "undef",    "include", "use"};

constexpr size_t most_kept = 1000;  // statements of one list that are kept before calls are deferred

bool is_reserved(std::string_view word) { return std::find(reserved.begin(), reserved.end(), word) != reserved.end(); }

// Returns text from the script, short enough for a message.
std::string quoted(std::string_view text) {
  const size_t line = text.find_first_of("\r\n");
  size_t size = std::min<size_t>({text.size(), line, 30});
  while (size > 0 && size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80) --size;
  return '"' + std::string(text.substr(0, size)) + (size < text.size() ? "...\"" : "\"");
}

}  // namespace

// Functions that read tokens.

Temporary<int> Parser::deeper() {
  if (depth_ >= deepest_nesting)
    fail(span(token()), "this nests deeper than " + std::to_string(deepest_nesting) + " levels",
         "give parts of it names of their own");
  return {depth_, depth_ + 1};
}

bool Parser::at_word(std::string_view word, size_t ahead) {
  const Token next = token(ahead);
  return next.kind == TokenKind::name && text(next) == word;
}

bool Parser::is_name(size_t ahead) { return kind(ahead) == TokenKind::name && !is_reserved(text(token(ahead))); }

bool Parser::accept(TokenKind wanted) {
  if (!at(wanted)) return false;
  take();
  return true;
}

std::string Parser::found() { return at(TokenKind::end) ? "the end of the file" : quoted(text(token())); }

void Parser::fail(Span where, std::string message, Phrase hint) {
  // An error at the end of the text follows from an unclosed string or comment.
  const bool is_consequence = tokens_.is_cut_short() && at(TokenKind::end);
  if (!is_consequence) diagnostics_.error(Code::syntax, where.range(), std::move(message), std::move(hint));
  throw SyntaxError{};
}

void Parser::fail_here(const std::string& expected, Phrase hint) {
  fail(span(token()), "expected " + expected + ", found " + found(), std::move(hint));
}

// Reports a missing token just after the last token, which may be lines before the next one.
void Parser::expect(TokenKind wanted, const char* what) {
  if (accept(wanted)) return;
  fail({source_, last_end(), last_end() + 1}, "expected \"" + std::string(what) + "\", found " + found());
}

Name Parser::name(const char* what) {
  if (!is_name()) {
    const bool is_word = kind() == TokenKind::name;
    fail_here(what, is_word ? quoted(text(token())) + " is a reserved word" : "");
  }
  const Name result = name_at(span(token()), text(token()));
  take();
  return result;
}

Name Parser::name_at(Span where, std::string_view text) { return {names_.intern(text), where}; }

// Functions that read statements.

std::vector<StatementPtr> Parser::file() {
  std::vector<StatementPtr> result;
  statements(result, false);
  return result;
}

void Parser::statements(std::vector<StatementPtr>& into, bool inside_braces) {
  while (!at(TokenKind::end)) {
    if (accept(TokenKind::semicolon)) continue;
    if (at(TokenKind::right_brace)) {
      if (inside_braces) return;
      diagnostics_.error(Code::syntax, span(token()).range(), "this \"}\" closes nothing",
                         "remove it, or write the \"{\" it belongs to");
      take();
      continue;
    }
    try {
      into.push_back(statement());
      if (into.size() > most_kept) defer(into.back());
    } catch (const SyntaxError&) {
      resynchronise();
    }
  }
}

// Defers a call. A design may be a list of a million calls, whose tree would be many times as large as its text. Calls
// that are evaluated once are therefore read again one by one; calls in loops and modules are kept.
void Parser::defer(StatementPtr& statement) const {
  if (!defers_ || is_repeated_ || statement->kind != Statement::Kind::call) return;
  statement = std::make_unique<Deferred>(*statement);
}

// Continues after the next ";" or "}" at this level, and skips braces that open on the way.
void Parser::resynchronise() {
  int open = 0;
  for (; !at(TokenKind::end); take()) {
    if (at(TokenKind::left_brace)) ++open;
    if (at(TokenKind::semicolon) && open == 0) return take();
    if (!at(TokenKind::right_brace)) continue;
    if (open == 0) return;
    if (--open == 0) return take();
  }
}

StatementPtr Parser::statement() {
  if (at(TokenKind::include_path) || at(TokenKind::use_path)) return include();
  if (at(TokenKind::left_brace)) return group();
  if (at_word("module")) return module_definition();
  // "function(" calls the node of that name.
  if (at_word("function") && kind(1) != TokenKind::left_paren) return function_definition();
  if (is_name() && kind(1) == TokenKind::assign) return assignment();
  return instantiation();
}

StatementPtr Parser::include() {
  const Token path = token();
  const std::string_view all = text(path);
  const auto open = static_cast<uint32_t>(all.find('<') + 1);
  const Span inside{source_, path.begin + open, path.end - 1};
  const std::string name(text_.substr(inside.begin, inside.end - inside.begin));
  take();
  if (depth_ > 0)
    diagnostics_.error(Code::syntax, span(path).range(), "files are included at the top level of a file only",
                       "move this line out of the braces");
  return std::make_unique<Include>(span(path), path.kind == TokenKind::use_path, name, inside);
}

StatementPtr Parser::group() {
  const auto level = deeper();
  auto result = std::make_unique<Group>(span(token()));
  take();
  statements(result->statements, true);
  expect(TokenKind::right_brace, "}");
  result->span = since(result->span.begin);
  return result;
}

StatementPtr Parser::assignment() {
  const Name target = name("a name");
  take();
  auto result = std::make_unique<Assign>(target, expression());
  end_of_statement("assignment");
  return result;
}

// Reads the keyword, the name and the parameters.
template <class Definition>
std::unique_ptr<Definition> Parser::definition(const char* what) {
  auto result = std::make_unique<Definition>(span(token()));
  take();
  result->name = name(what);
  parameters(result->parameters);
  if (dialect_ == Dialect::vcad)
    if (auto declared = read_declaration(*result, diagnostics_))
      result->declaration = std::make_shared<const Declaration>(std::move(*declared));
  return result;
}

StatementPtr Parser::function_definition() {
  auto result = definition<FunctionDef>("the name of the function");
  expect(TokenKind::assign, "=");
  result->body = expression();
  result->span = since(result->span.begin);
  end_of_statement("function");
  return result;
}

StatementPtr Parser::module_definition() {
  auto result = definition<ModuleDef>("the name of the module");
  const auto level = deeper();
  const Temporary repeated(is_repeated_, true);
  block(result->body, "the module's statements");
  result->span = since(result->span.begin);
  return result;
}

StatementPtr Parser::instantiation() {
  const auto level = deeper();
  Modifiers modifiers;
  for (;; take()) {
    if (at(TokenKind::star))
      modifiers.add('*');
    else if (at(TokenKind::bang))
      modifiers.add('!');
    else if (at(TokenKind::hash))
      modifiers.add('#');
    else if (at(TokenKind::percent))
      modifiers.add('%');
    else
      break;
  }
  if (at_word("if")) return condition(modifiers);
  if (at_word("else"))
    fail(span(token()), "this \"else\" belongs to no \"if\"", "write it right after the if's statement");
  return call(modifiers);
}

StatementPtr Parser::condition(Modifiers modifiers) {
  auto result = std::make_unique<Condition>(span(token()));
  result->modifiers = modifiers;
  while (at_word("if")) {
    take();
    expect(TokenKind::left_paren, "(");
    result->branches.emplace_back(expression(), Block{});
    expect(TokenKind::right_paren, ")");
    block(result->branches.back().second, "the statements of \"if\"");
    if (!at_word("else")) break;
    take();
    if (at_word("if")) continue;
    result->has_otherwise = true;
    block(result->otherwise, "the statements of \"else\"");
    break;
  }
  result->span = since(result->span.begin);
  return result;
}

Statement::Kind Parser::call_kind(std::string_view name) {
  if (name == "for") return Statement::Kind::loop;
  if (name == "let") return Statement::Kind::let;
  if (name == "assert") return Statement::Kind::assertion;
  if (name == "echo") return Statement::Kind::echo;
  return Statement::Kind::call;
}

// Returns the number of tokens of a name with hyphens, such as F-grade, where a call begins: its parts are adjacent and
// precede "(" or "{".
size_t Parser::hyphenated_tokens() {
  size_t count = 1;
  if (dialect_ == Dialect::openscad) return count;
  while (kind(count) == TokenKind::minus && kind(count + 1) == TokenKind::name &&
         token(count).begin == token(count - 1).end && token(count + 1).begin == token(count).end)
    count += 2;
  const bool is_call = kind(count) == TokenKind::left_paren || kind(count) == TokenKind::left_brace;
  return is_call ? count : 1;
}

Name Parser::call_name() {
  const bool may_be_reserved = call_kind(text(token())) != Statement::Kind::call || at_word("function");
  if (kind() != TokenKind::name || (!is_name() && !may_be_reserved && hyphenated_tokens() == 1))
    fail_here("a statement", "such as name(arguments); or name = value;");
  const size_t count = hyphenated_tokens();
  const Span where = span(token()).to(span(token(count - 1)));
  for (size_t i = 0; i < count; ++i) take();
  return name_at(where, text_.substr(where.begin, where.end - where.begin));
}

StatementPtr Parser::call(Modifiers modifiers) {
  const Name callee = call_name();
  auto result = std::make_unique<CallStatement>(call_kind(callee.text()), callee);
  result->modifiers = modifiers;
  const bool is_node = result->kind == Statement::Kind::call;
  if (at(TokenKind::left_paren)) {
    if (result->kind == Statement::Kind::loop || result->kind == Statement::Kind::let) {
      take();
      named_arguments(result->arguments, callee.text().c_str(), TokenKind::right_paren);
      expect(TokenKind::right_paren, ")");
    } else {
      arguments(result->arguments);
    }
  } else if (!is_node || !at(TokenKind::left_brace)) {
    std::string hint;
    if (at(TokenKind::minus)) hint = "names with a hyphen are written without spaces";
    fail(span(token()), "expected \"(\" after " + quoted(callee.text()) + ", found " + found(), hint);
  }
  result->whole = since(callee.span.begin);
  const Temporary repeated(is_repeated_, is_repeated_ || result->kind == Statement::Kind::loop);
  // The last statement before "}" may omit its ";".
  if (!accept(TokenKind::semicolon) && !at_last_of_braces())
    block(result->children, "\";\" or the children of the call");
  result->span = since(callee.span.begin);
  return result;
}

// Reads braces or a single call.
void Parser::block(Block& into, const char* owner) {
  if (at(TokenKind::left_brace)) return braces(into);
  if (accept(TokenKind::semicolon)) return;
  const bool is_call = kind() == TokenKind::name || at(TokenKind::star) || at(TokenKind::bang) || at(TokenKind::hash) ||
                       at(TokenKind::percent);
  if (!is_call || at_word("else") || at_word("module") || (is_name() && kind(1) == TokenKind::assign))
    fail({source_, last_end(), last_end() + 1}, "expected " + std::string(owner) + ", found " + found());
  into.statements.push_back(instantiation());
  finish(into);
}

void Parser::braces(Block& into) {
  const auto level = deeper();
  take();
  into.has_braces = true;
  statements(into.statements, true);
  finish(into);
  expect(TokenKind::right_brace, "}");
}

void Parser::finish(Block& block) {
  for (const StatementPtr& statement : block.statements) block.plan.add(*statement);
  if (dialect_ == Dialect::vcad) warn_of_replaced(block.plan, diagnostics_);
}

void Parser::end_of_statement(const char* after) {
  if (accept(TokenKind::semicolon) || at_last_of_braces()) return;
  const Span where{source_, last_end(), last_end() + 1};
  std::string message = "expected \";\" after this " + std::string(after) + ", found " + found();
  // A new line starts a new statement, which is parsed as usual.
  const std::string_view between = text_.substr(last_end(), token().begin - last_end());
  const bool is_new_line = between.find_first_of(line_ends) != std::string_view::npos;
  if (!is_new_line || at(TokenKind::end)) fail(where, std::move(message));
  diagnostics_.error(Code::syntax, where.range(), std::move(message));
}

void warn_of_replaced(const Plan& plan, Diagnostics& diagnostics) {
  for (const auto& [earlier, later] : plan.replaced) {
    if (earlier->span.source != later->span.source) continue;  // replacing values of included files is common
    const int line = (*earlier->span.source)->place(earlier->span.begin).line;
    diagnostics.warning(later->name.span.range(),
                        '"' + later->name.text() + "\" has a value already from line " + std::to_string(line),
                        "a variable has one value in its scope, the last one given");
  }
}

namespace {

File parse(const SourcePtr& source, std::shared_ptr<Names> names, Dialect dialect, bool defer,
           Diagnostics& diagnostics) {
  File file;
  file.source = std::make_unique<const SourcePtr>(source);
  file.names = std::move(names);
  if (source->text().size() >= UINT32_MAX / 2) {
    diagnostics.error(Code::limit, {source, 0, 1}, "the file is larger than 2 GB");
    return file;
  }
  Diagnostics lexical, syntactic;
  Parser parser(file.source.get(), 0, dialect, *file.names, lexical, syntactic);
  if (defer) parser.defer_calls();
  file.statements = parser.file();
  diagnostics.add_all(lexical);
  diagnostics.add_all(syntactic);
  return file;
}

}  // namespace

File parse(const SourcePtr& source, Diagnostics& diagnostics, Dialect dialect) {
  return parse(source, std::make_shared<Names>(), dialect, false, diagnostics);
}

File parse_deferred(const SourcePtr& source, std::shared_ptr<Names> names, Dialect dialect, Diagnostics& diagnostics) {
  return parse(source, std::move(names), dialect, true, diagnostics);
}

StatementPtr read(const Deferred& call, Names& names, Dialect dialect) {
  Diagnostics repeated;
  Parser parser(call.span.source, call.span.begin, dialect, names, repeated, repeated);
  parser.defer_calls();
  return parser.statement();
}

}  // namespace ombre::lang
