#include "expr/expression_parser.h"

#include <charconv>

#include "base/system/temporary.h"
#include "base/text/text.h"
#include "expr/functions.h"

namespace ombre::expr {
namespace {

struct Token {
  enum class Type { end, number, name, symbol } type = Type::end;
  std::string_view text;
  double number = 0;
  uint32_t begin = 0, end = 0;
};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct Operator {
  std::string_view spelling;
  Binary binary;
};

constexpr int level_conditional = 0, level_or = 1, level_and = 2, level_compare = 3, level_add = 4, level_multiply = 5,
              level_sign = 6, level_power = 7, level_atom = 8;

int level_of(Binary binary) {
  switch (binary) {
    case Binary::logical_or:
    case Binary::logical_xor:
    case Binary::logical_nor:
      return level_or;
    case Binary::logical_and:
    case Binary::logical_nand:
      return level_and;
    case Binary::add:
    case Binary::subtract:
      return level_add;
    case Binary::multiply:
    case Binary::divide:
    case Binary::mod:
      return level_multiply;
    case Binary::power:
      return level_power;
    default:
      return level_compare;
  }
}

// Spellings of operators. The first spelling of each is the canonical one.
constexpr Operator operators[] = {
    {"+", Binary::add},           {"-", Binary::subtract},
    {"*", Binary::multiply},      {"/", Binary::divide},
    {"%", Binary::mod},           {"^", Binary::power},
    {"<", Binary::less},          {"<=", Binary::less_equal},
    {">", Binary::greater},       {">=", Binary::greater_equal},
    {"==", Binary::equal},        {"!=", Binary::not_equal},
    {"and", Binary::logical_and}, {"or", Binary::logical_or},
    {"xor", Binary::logical_xor}, {"nand", Binary::logical_nand},
    {"nor", Binary::logical_nor}, {"=", Binary::equal},
    {"<>", Binary::not_equal},    {"&&", Binary::logical_and},
    {"||", Binary::logical_or},   {"&", Binary::logical_and},
    {"|", Binary::logical_or},
};

class Parser {
 public:
  Parser(std::string_view text, const SourceRange& where, Diagnostics& diagnostics)
      : text_(text), where_(where), diagnostics_(diagnostics) {}

  NodePtr run() {
    advance();
    if (now_.type == Token::Type::end && !failed_)
      fail(now_, "the expression is empty", "write one, such as \"x^2 + y^2 - 4\"");
    NodePtr root = expression(level_conditional);
    if (!failed_ && now_.type != Token::Type::end) unexpected("an operator or the end of the expression");
    return failed_ ? nullptr : root;
  }

 private:
  static constexpr int deepest = 200, most_operators = 200000;

  // Functions that read tokens.

  void advance() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
    now_ = {};
    now_.begin = static_cast<uint32_t>(at_);
    if (at_ < text_.size()) read_token();
    now_.end = static_cast<uint32_t>(at_);
    now_.text = text_.substr(now_.begin, now_.end - now_.begin);
  }

  void read_token() {
    const char c = text_[at_];
    if (is_digit(c) || (c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))) return read_number();
    if (is_letter(c)) {
      now_.type = Token::Type::name;
      while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || begins_part())) ++at_;
      return;
    }
    now_.type = Token::Type::symbol;
    const std::string_view two = text_.substr(at_, 2);
    if (two == "<=" || two == ">=" || two == "==" || two == "!=" || two == "<>" || two == "&&" || two == "||" ||
        two == ":=")
      at_ += 2;
    else
      ++at_;
    while (at_ < text_.size() && (static_cast<unsigned char>(text_[at_]) & 0xC0) == 0x80)
      ++at_;  // skips the other bytes of a UTF-8 character
  }

  // True at a dot that joins names, as in "fibre.x".
  bool begins_part() const { return text_[at_] == '.' && at_ + 1 < text_.size() && is_letter(text_[at_ + 1]); }

  void read_number() {
    now_.type = Token::Type::number;
    const char* begin = text_.data() + at_;
    const auto [end, status] = std::from_chars(begin, text_.data() + text_.size(), now_.number);
    at_ += static_cast<size_t>(end - begin);
    if (status != std::errc()) {
      now_.end = static_cast<uint32_t>(at_);
      fail(now_, "this number is too large or too small");
    }
  }

  bool is_symbol(std::string_view symbol) const { return now_.type == Token::Type::symbol && now_.text == symbol; }

  // Reports an error. Only the first error of an expression is reported, since the others mostly follow from it.

  void fail(const Token& token, std::string message, Phrase hint = {}) {
    if (failed_) return;
    failed_ = true;
    diagnostics_.error(Code::expression, where_.part(token.begin, std::max(token.end, token.begin + 1)),
                       std::move(message), std::move(hint));
  }

  void unexpected(const std::string& expected) {
    if (now_.type == Token::Type::end) return fail(now_, "the expression ends where " + expected + " was expected");
    if (is_symbol(":=") || is_symbol(";"))
      return fail(now_, "assignments and several statements are not supported in an expression",
                  "compute the value in the script and splice it in with str()");
    if (is_symbol("[") || is_symbol("{"))
      return fail(now_, "loops, vectors and blocks are not supported in an expression");
    fail(now_, "expected " + expected + ", found \"" + std::string(now_.text) + "\"");
  }

  bool expect(std::string_view symbol) {
    if (is_symbol(symbol)) {
      advance();
      return true;
    }
    unexpected("\"" + std::string(symbol) + "\"");
    return false;
  }

  // Functions that build trees.

  static std::shared_ptr<Node> make(Kind kind, uint32_t begin, uint32_t end) {
    auto node = std::make_shared<Node>();
    node->kind = kind;
    node->begin = begin;
    node->end = end;
    return node;
  }

  NodePtr expression(int least_level) {
    const Temporary level(depth_, depth_ + 1);
    if (depth_ > deepest) {
      fail(now_, "this nests deeper than " + std::to_string(deepest) + " levels");
      return nullptr;
    }
    NodePtr left = operand();
    while (!failed_) {
      const auto binary = next_operator();
      if (!binary) {
        if (least_level <= level_conditional && is_symbol("?")) return conditional(left);
        return left;
      }
      const int level = level_of(*binary);
      if (level < least_level) return left;
      if (++operators_ > most_operators)
        fail(now_, "this expression has more than " + format_count(most_operators) + " operators");
      if (!implicit_) advance();
      // Powers associate to the right, all other operators to the left.
      const NodePtr right = *binary == Binary::power ? power_exponent() : expression(level + 1);
      if (failed_) return nullptr;
      auto node = make(Kind::binary, left->begin, right->end);
      node->binary = *binary;
      node->operands = {left, right};
      left = node;
    }
    return nullptr;
  }

  // Returns the next operator. Two adjacent operands are multiplied.
  std::optional<Binary> next_operator() {
    implicit_ = false;
    if (now_.type == Token::Type::symbol || now_.type == Token::Type::name) {
      const std::string lower = to_lower(now_.text);
      for (const Operator& op : operators)
        if (op.spelling == lower) return op.binary;
    }
    if (now_.type == Token::Type::number || now_.type == Token::Type::name || is_symbol("(")) {
      implicit_ = true;
      return Binary::multiply;
    }
    return std::nullopt;
  }

  // Reads an exponent: -x^2 is -(x^2), 2^-x is 2^(-x), 2^3^2 is 2^(3^2).
  NodePtr power_exponent() { return expression(level_power); }

  NodePtr conditional(const NodePtr& condition) {
    advance();
    const NodePtr yes = expression(level_conditional);
    if (failed_ || !expect(":")) return nullptr;
    const NodePtr no = expression(level_conditional);
    if (failed_) return nullptr;
    auto node = make(Kind::conditional, condition->begin, no->end);
    node->operands = {condition, yes, no};
    return node;
  }

  NodePtr operand() {
    const Token token = now_;
    switch (token.type) {
      case Token::Type::number: {
        advance();
        auto node = make(Kind::number, token.begin, token.end);
        node->number = token.number;
        return node;
      }
      case Token::Type::name:
        return name();
      case Token::Type::symbol:
        if (token.text == "(") {
          advance();
          const NodePtr inner = expression(level_conditional);
          if (failed_ || !expect(")")) return nullptr;
          return inner;
        }
        if (token.text == "-" || token.text == "+" || token.text == "!") return sign(token);
        break;
      case Token::Type::end:
        break;
    }
    unexpected("a number, a name or \"(\"");
    return nullptr;
  }

  NodePtr sign(const Token& token) {
    advance();
    const NodePtr inner = expression(level_power);
    if (failed_ || token.text == "+") return inner;
    auto node = make(token.text == "-" ? Kind::negate : Kind::logical_not, token.begin, inner->end);
    node->operands = {inner};
    return node;
  }

  NodePtr name() {
    const Token token = now_;
    const std::string lower = to_lower(token.text);
    advance();
    if (lower == "not") {
      const NodePtr inner = expression(level_power);
      if (failed_) return nullptr;
      auto node = make(Kind::logical_not, token.begin, inner->end);
      node->operands = {inner};
      return node;
    }
    if (is_symbol("(")) {
      const Function* function = find_function(lower);
      if (function) return call(token, *function);
      // A name before a bracket, as in x(y + 1), is a variable times the bracket; any other name is a misspelt
      // function.
      if (!is_variable_like(lower)) {
        unknown_function(token);
        return nullptr;
      }
    } else if (find_function(lower)) {
      fail(token, "the function " + lower + " needs its arguments", "write " + lower + "(...)");
      return nullptr;
    }
    auto node = make(Kind::variable, token.begin, token.end);
    if (lower == "pi" || lower == "e" || lower == "true" || lower == "false") {
      node->kind = Kind::number;
      node->number = lower == "pi" ? 3.14159265358979323846 : lower == "e" ? 2.71828182845904523536 : lower == "true";
      return node;
    }
    node->name = lower;
    return node;
  }

  static bool is_variable_like(const std::string& lower) {
    for (const std::string& coordinate : coordinate_names())
      if (coordinate == lower) return true;
    return lower == "d" || lower == "pi" || lower == "e" || lower == "true" || lower == "false";
  }

  void unknown_function(const Token& token) {
    std::vector<std::string> names;
    for (const Function& function : functions()) names.emplace_back(function.name);
    fail(token, "there is no function \"" + std::string(token.text) + "\" in expressions",
         did_you_mean(token.text, names));
  }

  NodePtr call(const Token& token, const Function& function) {
    advance();
    auto node = make(Kind::call, token.begin, token.end);
    node->name = function.name;
    while (!failed_ && !is_symbol(")")) {
      const NodePtr argument = expression(level_conditional);
      if (failed_) return nullptr;
      node->operands.push_back(argument);
      if (is_symbol(",")) {
        advance();
        if (is_symbol(")")) unexpected("another argument");
        continue;
      }
      if (!is_symbol(")")) unexpected("\",\" or \")\"");
    }
    if (failed_) return nullptr;
    node->end = now_.end;
    advance();
    const int count = static_cast<int>(node->operands.size());
    if (count >= function.least && (function.most < 0 || count <= function.most)) return node;
    Token whole = token;
    whole.end = node->end;
    fail(whole, std::string(function.name) + " takes (" + std::string(function.arguments) + "), " +
                    (count == 1 ? "1 argument was" : std::to_string(count) + " arguments were") + " given");
    return nullptr;
  }

  std::string_view text_;
  SourceRange where_;
  Diagnostics& diagnostics_;
  size_t at_ = 0;
  Token now_;
  bool failed_ = false, implicit_ = false;
  int depth_ = 0, operators_ = 0;
};

std::string_view spelling(Binary binary) {
  for (const Operator& op : operators)
    if (op.binary == binary) return op.spelling;
  return "?";
}

int level_of(const Node& node) {
  switch (node.kind) {
    case Kind::binary:
      return level_of(node.binary);
    case Kind::negate:
    case Kind::logical_not:
      return level_sign;
    case Kind::conditional:
      return level_conditional;
    case Kind::number:
      return node.number < 0 ? level_sign : level_atom;
    default:
      return level_atom;
  }
}

class Printer {
 public:
  explicit Printer(const InputNames& names) : names_(names) {}

  std::string print(const Node& node) const {
    switch (node.kind) {
      case Kind::number:
        return format_number(node.number);
      case Kind::variable:
        return node.name;
      case Kind::source:
        return node.source->name();
      case Kind::input:
        return names_ ? names_(*node.input) : node.input->name();
      case Kind::negate:
        return "-" + signed_operand(*node.operands[0]);
      case Kind::logical_not:
        return "not " + signed_operand(*node.operands[0]);
      case Kind::conditional:
        return bracketed(*node.operands[0], level_or) + " ? " + print(*node.operands[1]) + " : " +
               print(*node.operands[2]);
      case Kind::call: {
        std::string text = node.name + "(";
        for (size_t i = 0; i < node.operands.size(); ++i) text += (i ? ", " : "") + print(*node.operands[i]);
        return text + ")";
      }
      case Kind::binary:
        break;
    }
    return print_chain(node);
  }

 private:
  // Prints a chain of left operands without recursion, since it may be long.
  std::string print_chain(const Node& node) const {
    std::vector<const Node*> chain{&node};
    const int level = level_of(node);
    while (chain.back()->operands[0]->kind == Kind::binary && level_of(*chain.back()->operands[0]) == level &&
           level != level_power)
      chain.push_back(chain.back()->operands[0].get());
    std::string text = bracketed(*chain.back()->operands[0], level == level_power ? level + 1 : level);
    for (size_t i = chain.size(); i-- > 0;) {
      const bool tight = level >= level_multiply;
      const std::string op(spelling(chain[i]->binary));
      text += (tight ? op : " " + op + " ") + (level == level_power ? signed_operand(*chain[i]->operands[1])
                                                                    : bracketed(*chain[i]->operands[1], level + 1));
    }
    return text;
  }

  std::string bracketed(const Node& node, int least_level) const {
    std::string text = print(node);
    return level_of(node) < least_level ? "(" + text + ")" : text;
  }

  // Prints an operand of a sign or of ^, which may have a sign of its own. Adds no more brackets than the text had, so
  // that what was parsed can be parsed again.
  std::string signed_operand(const Node& node) const {
    const bool is_signed = node.kind == Kind::negate || node.kind == Kind::logical_not;
    return is_signed ? print(node) : bracketed(node, level_power);
  }

  const InputNames& names_;
};

}  // namespace

NodePtr parse_tree(std::string_view text, const SourceRange& where, Diagnostics& diagnostics) {
  return Parser(text, where, diagnostics).run();
}

std::string print_tree(const Node& node, const InputNames& names) { return Printer(names).print(node); }

}  // namespace ombre::expr
