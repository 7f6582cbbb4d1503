// The part of the parser that reads expressions.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <optional>

#include "lang/syntax/parser_state.h"

namespace ombre::lang {

using namespace ast;

namespace {

struct BinaryOperator {
  TokenKind token;
  Operator op;
  int precedence;
};

constexpr std::array<BinaryOperator, 17> binary_operators = {{{TokenKind::or_or, Operator::logical_or, 0},
                                                              {TokenKind::and_and, Operator::logical_and, 1},
                                                              {TokenKind::equal_equal, Operator::equal, 2},
                                                              {TokenKind::not_equal, Operator::not_equal, 2},
                                                              {TokenKind::less, Operator::less, 3},
                                                              {TokenKind::less_equal, Operator::less_equal, 3},
                                                              {TokenKind::greater, Operator::greater, 3},
                                                              {TokenKind::greater_equal, Operator::greater_equal, 3},
                                                              {TokenKind::bar, Operator::bit_or, 4},
                                                              {TokenKind::ampersand, Operator::bit_and, 5},
                                                              {TokenKind::shift_left, Operator::shift_left, 6},
                                                              {TokenKind::shift_right, Operator::shift_right, 6},
                                                              {TokenKind::plus, Operator::add, 7},
                                                              {TokenKind::minus, Operator::subtract, 7},
                                                              {TokenKind::star, Operator::multiply, 8},
                                                              {TokenKind::slash, Operator::divide, 8},
                                                              {TokenKind::percent, Operator::modulo, 8}}};
constexpr int tightest = 8;

const BinaryOperator* binary_operator(TokenKind token) {
  // Most tokens after a value are not operators, so they are excluded first.
  if (token < TokenKind::bar) return nullptr;
  const auto* found = std::find_if(binary_operators.begin(), binary_operators.end(),
                                   [token](const BinaryOperator& op) { return op.token == token; });
  return found == binary_operators.end() ? nullptr : found;
}

int hexadecimal_digit(char digit) {
  if (digit <= '9') return digit - '0';
  return (digit <= 'F' ? digit - 'A' : digit - 'a') + 10;
}

bool may_generate(const Expr& element) {
  return element.kind >= Expr::Kind::generate_for || element.kind == Expr::Kind::prefix;
}

std::optional<Operator> unary_operator(TokenKind token) {
  if (token == TokenKind::minus) return Operator::negate;
  if (token == TokenKind::plus) return Operator::plus;
  if (token == TokenKind::bang) return Operator::logical_not;
  if (token == TokenKind::tilde) return Operator::bit_not;
  return std::nullopt;
}

}  // namespace

ExprPtr Parser::expression() {
  const auto level = deeper();
  if (!at(TokenKind::name)) return conditional();
  if (at_word("function")) return function_literal();
  if (at_word("let")) return prefix(PrefixKind::let, false);
  if (at_word("assert")) return prefix(PrefixKind::assertion, false);
  if (at_word("echo")) return prefix(PrefixKind::echo, false);
  return conditional();
}

ExprPtr Parser::conditional() {
  ExprPtr value = chain(0);
  if (!at(TokenKind::question)) return value;
  auto result = std::make_unique<Conditional>(value->span);
  while (accept(TokenKind::question)) {
    ExprPtr yes = expression();
    expect(TokenKind::colon, ":");
    result->branches.emplace_back(std::move(value), std::move(yes));
    const bool is_prefixed = at_word("function") || at_word("let") || at_word("assert") || at_word("echo");
    value = is_prefixed ? expression() : chain(0);
  }
  result->otherwise = std::move(value);
  result->span = since(result->span.begin);
  return result;
}

// Reads operators of `precedence` and of tighter ones.
ExprPtr Parser::chain(int precedence) {
  ExprPtr value = unary();
  for (int level = tightest; level >= precedence && binary_operator(kind()); --level)
    value = links(level, std::move(value));
  return value;
}

// Reads the operators of `precedence` that follow the first operand.
ExprPtr Parser::links(int precedence, ExprPtr first) {
  std::unique_ptr<Chain> result;
  for (const BinaryOperator* op = binary_operator(kind()); op && op->precedence == precedence;
       op = binary_operator(kind())) {
    if (!result) result = std::make_unique<Chain>(std::move(first));
    const Span op_span = span(token());
    take();
    result->links.push_back({op->op, op_span, chain(precedence + 1)});
  }
  if (!result) return first;
  result->span = since(result->span.begin);
  return result;
}

ExprPtr Parser::unary() {
  const auto op = unary_operator(kind());
  if (!op) return power();
  const auto level = deeper();
  const uint32_t begin = token().begin;
  take();
  ExprPtr operand = unary();
  return std::make_unique<Unary>(since(begin), *op, std::move(operand));
}

// Powers bind tighter than a sign before them, and associate to the right: -2^2 is -4, 2^3^2 is 2^9.
ExprPtr Parser::power() {
  ExprPtr base = postfix();
  if (!at(TokenKind::caret)) return base;
  const auto level = deeper();
  const Span op_span = span(token());
  take();
  ExprPtr exponent = unary();
  return std::make_unique<Power>(std::move(base), op_span, std::move(exponent));
}

ExprPtr Parser::postfix() {
  ExprPtr value = primary();
  for (int length = 0;; ++length) {
    const bool goes_on = at(TokenKind::left_paren) || at(TokenKind::left_bracket) || at(TokenKind::dot);
    if (!goes_on) return value;
    if (length == deepest_nesting)
      fail(span(token()),
           "calls and indices follow each other more than " + std::to_string(deepest_nesting) + " times");
    const uint32_t begin = value->span.begin;
    if (at(TokenKind::left_paren)) {
      auto call = std::make_unique<Call>(std::move(value));
      arguments(call->arguments);
      value = std::move(call);
    } else if (accept(TokenKind::left_bracket)) {
      auto index = std::make_unique<Index>(std::move(value));
      index->index = expression();
      expect(TokenKind::right_bracket, "]");
      value = std::move(index);
    } else {
      take();
      value = std::make_unique<Member>(std::move(value), name("x, y or z after \".\""));
    }
    value->span = since(begin);
  }
}

ExprPtr Parser::primary() {
  switch (kind()) {
    case TokenKind::number:
      return number();
    case TokenKind::string:
      return string();
    case TokenKind::left_paren:
      return parenthesised();
    case TokenKind::left_bracket:
      return bracketed();
    case TokenKind::name:
      break;
    default:
      fail_here("a value");
  }
  const Span where = span(token());
  if (at_word("undef")) return take(), std::make_unique<Undef>(where);
  if (at_word("true")) return take(), std::make_unique<Boolean>(where, true);
  if (at_word("false")) return take(), std::make_unique<Boolean>(where, false);
  if (at_generator())
    fail_here("a value", "loops and conditions inside of expressions stand in list brackets, [for (...) ...]");
  if (!is_name()) fail_here("a value");
  return std::make_unique<Variable>(name("a value"));
}

ExprPtr Parser::number() {
  const Span where = span(token());
  const std::string_view digits = text(token());
  double value = 0;
  if (digits.size() > 2 && (digits[1] == 'x' || digits[1] == 'X')) {
    for (const char digit : digits.substr(2)) value = value * 16 + hexadecimal_digit(digit);
    take();
    return std::make_unique<Number>(where, value);
  }
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (dialect_ == Dialect::openscad && status == std::errc::result_out_of_range)
    value = std::strtod(std::string(digits).c_str(), nullptr);
  else if (status != std::errc() || end != digits.data() + digits.size())
    diagnostics_.error(Code::syntax, where.range(), "this number is out of range",
                       "numbers reach from 1e-307 to 1e308");
  take();
  return std::make_unique<Number>(where, value);
}

ExprPtr Parser::string() {
  const Span where = span(token());
  StringValue value = read_string(*source_, token(), dialect_, diagnostics_);
  take();
  return std::make_unique<String>(where, std::move(value.text), value.is_plain);
}

// Reads (a), which groups, or (a, b), which is a vector.
ExprPtr Parser::parenthesised() {
  const uint32_t begin = token().begin;
  take();
  if (at(TokenKind::right_paren))
    fail(since(begin).to(span(token())), "these parentheses are empty", "an empty list is []");
  ExprPtr first = expression();
  if (dialect_ == Dialect::openscad || at(TokenKind::right_paren)) {
    expect(TokenKind::right_paren, ")");
    first->span = since(begin);
    return first;
  }
  auto tuple = std::make_unique<List>(first->span);
  tuple->is_tuple = true;
  tuple->elements.push_back(std::move(first));
  while (accept(TokenKind::comma)) {
    if (at(TokenKind::right_paren)) break;
    tuple->elements.push_back(expression());
  }
  expect(TokenKind::right_paren, ")");
  tuple->span = since(begin);
  if (tuple->elements.size() == 1)
    diagnostics_.error(Code::syntax, tuple->span.range(), "a tuple has at least 2 elements",
                       "a list of one is written [a]");
  return tuple;
}

// Reads a list or a range.
ExprPtr Parser::bracketed() {
  const uint32_t begin = token().begin;
  take();
  auto list = std::make_unique<List>(since(begin));
  skip_empty_places();
  while (!at(TokenKind::right_bracket)) {
    list->elements.push_back(element());
    list->has_generators = list->has_generators || may_generate(*list->elements.back());
    if (at(TokenKind::colon) && list->elements.size() == 1 && !list->has_generators) break;
    if (!accept(TokenKind::comma)) break;
    skip_empty_places();
  }
  if (!accept(TokenKind::colon)) {
    if (!at(TokenKind::right_bracket))
      fail({source_, last_end(), last_end() + 1}, "expected \",\" or \"]\" in this list, found " + found());
    take();
    list->span = since(begin);
    return list;
  }
  auto range = std::make_unique<Range>(list->span);
  range->begin = std::move(list->elements.front());
  range->end = expression();
  if (accept(TokenKind::colon)) {
    range->step = std::move(range->end);
    range->end = expression();
  }
  expect(TokenKind::right_bracket, "]");
  range->span = since(begin);
  return range;
}

bool Parser::at_generator(size_t ahead) {
  return at_word("for", ahead) || at_word("each", ahead) || at_word("if", ahead);
}

// True at (for ...), also after let(...); what follows distinguishes it from a value in parentheses.
bool Parser::at_parenthesised_generator() {
  if (!at(TokenKind::left_paren)) return false;
  size_t ahead = 1;
  while (at_word("let", ahead) && kind(ahead + 1) == TokenKind::left_paren) {
    int open = 0;
    do {
      ++ahead;
      open += kind(ahead) == TokenKind::left_paren ? 1 : kind(ahead) == TokenKind::right_paren ? -1 : 0;
    } while (open > 0 && kind(ahead) != TokenKind::end);
    ++ahead;
  }
  return at_generator(ahead);
}

// Reads an element of a list: a value, or a generator of several values.
ExprPtr Parser::element() {
  if (at_generator()) return generator();
  if (at_word("let")) return prefix(PrefixKind::let, true);
  if (!at_parenthesised_generator()) return expression();
  const auto level = deeper();
  take();
  ExprPtr inner = element();
  expect(TokenKind::right_paren, ")");
  return inner;
}

ExprPtr Parser::generator() {
  const auto level = deeper();
  if (at_word("for")) return generate_for();
  const uint32_t begin = token().begin;
  if (at_word("each")) {
    auto each = std::make_unique<GenerateEach>(span(token()));
    take();
    each->element = element();
    each->span = since(begin);
    return each;
  }
  auto choice = std::make_unique<GenerateIf>(span(token()));
  take();
  expect(TokenKind::left_paren, "(");
  choice->condition = expression();
  expect(TokenKind::right_paren, ")");
  choice->element = element();
  if (at_word("else")) {
    take();
    choice->otherwise = element();
  }
  choice->span = since(begin);
  return choice;
}

ExprPtr Parser::generate_for() {
  const Span begin = span(token());
  take();
  expect(TokenKind::left_paren, "(");
  std::vector<Argument> loops;
  named_arguments(loops, "for", TokenKind::semicolon);
  if (!accept(TokenKind::semicolon)) {
    expect(TokenKind::right_paren, ")");
    auto result = std::make_unique<GenerateFor>(begin);
    result->loops = std::move(loops);
    result->element = element();
    result->span = since(begin.begin);
    return result;
  }
  auto result = std::make_unique<GenerateLoop>(begin);
  result->init = std::move(loops);
  result->condition = expression();
  expect(TokenKind::semicolon, ";");
  named_arguments(result->next, "for", TokenKind::right_paren);
  expect(TokenKind::right_paren, ")");
  result->element = element();
  result->span = since(begin.begin);
  return result;
}

ExprPtr Parser::function_literal() {
  auto result = std::make_unique<Function>(span(token()));
  take();
  parameters(result->parameters);
  result->body = expression();
  result->span = since(result->span.begin);
  return result;
}

bool Parser::at_expression_end() {
  switch (kind()) {
    case TokenKind::end:
    case TokenKind::comma:
    case TokenKind::semicolon:
    case TokenKind::colon:
    case TokenKind::right_paren:
    case TokenKind::right_bracket:
    case TokenKind::right_brace:
      return true;
    default:
      return at_word("else");
  }
}

ExprPtr Parser::prefix(PrefixKind which, bool inside_list) {
  const auto level = deeper();
  auto result = std::make_unique<Prefix>(span(token()), which);
  take();
  if (which == PrefixKind::let) {
    expect(TokenKind::left_paren, "(");
    named_arguments(result->arguments, "let", TokenKind::right_paren);
    expect(TokenKind::right_paren, ")");
  } else {
    arguments(result->arguments);
  }
  if (which == PrefixKind::let || !at_expression_end()) result->value = inside_list ? element() : expression();
  result->span = since(result->span.begin);
  return result;
}

void Parser::arguments(std::vector<Argument>& into) {
  expect(TokenKind::left_paren, "(");
  arguments_until(TokenKind::right_paren, into);
  if (accept(TokenKind::right_paren)) return;
  fail({source_, last_end(), last_end() + 1}, "expected \",\" or \")\" after this argument, found " + found());
}

// OpenSCAD passes over empty places: [1,,2] is [1, 2].
void Parser::skip_empty_places() {
  while (dialect_ == Dialect::openscad && accept(TokenKind::comma)) {
  }
}

void Parser::arguments_until(TokenKind close, std::vector<Argument>& into) {
  skip_empty_places();
  while (!at(close) && !at(TokenKind::right_paren)) {
    Argument argument;
    if (is_name() && kind(1) == TokenKind::assign) {
      argument.name = name("a name");
      take();
    }
    argument.value = expression();
    into.push_back(std::move(argument));
    if (!accept(TokenKind::comma)) return;
    skip_empty_places();
  }
}

// Reads the arguments of for and let, which assign values to names.
void Parser::named_arguments(std::vector<Argument>& into, const char* owner, TokenKind close) {
  arguments_until(close, into);
  if (dialect_ == Dialect::openscad) return;  // OpenSCAD accepts values without names
  for (const Argument& argument : into)
    if (!argument.name.symbol)
      fail(argument.value->span, '"' + std::string(owner) + "\" gives values to names, and here is no name",
           "write name = value");
}

void Parser::parameters(std::vector<Parameter>& into) {
  expect(TokenKind::left_paren, "(");
  skip_empty_places();
  while (!at(TokenKind::right_paren)) {
    Parameter parameter{name("the name of a parameter"), nullptr};
    if (accept(TokenKind::assign)) parameter.value = expression();
    parameter.whole = since(parameter.name.span.begin);
    for (const Parameter& other : into)
      if (dialect_ == Dialect::vcad && other.name.symbol == parameter.name.symbol)
        diagnostics_.error(Code::twice, parameter.name.span.range(),
                           "the parameter \"" + other.name.text() + "\" is there already", {},
                           {{"name", other.name.text()}});
    into.push_back(std::move(parameter));
    if (!accept(TokenKind::comma)) break;
    skip_empty_places();
  }
  expect(TokenKind::right_paren, ")");
}

}  // namespace ombre::lang
