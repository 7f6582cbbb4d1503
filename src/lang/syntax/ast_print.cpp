#include "lang/syntax/ast_print.h"

#include "base/text/text.h"

namespace ombre::lang {

using namespace ast;

namespace {

// Precedence levels. An operand with a lower level than its place requires needs parentheses.
enum Tightness {
  loosest = 0,
  tight_conditional = 1,
  tight_chain = 2,
  tight_unary = 9,
  tight_power = 10,
  tight_postfix = 11
};

int chain_tightness(Operator op) {
  switch (op) {
    case Operator::logical_or:
      return tight_chain;
    case Operator::logical_and:
      return tight_chain + 1;
    case Operator::equal:
    case Operator::not_equal:
      return tight_chain + 2;
    case Operator::less:
    case Operator::less_equal:
    case Operator::greater:
    case Operator::greater_equal:
      return tight_chain + 3;
    case Operator::add:
    case Operator::subtract:
      return tight_chain + 4;
    default:
      return tight_chain + 5;
  }
}

int tightness(const Expr& expr) {
  switch (expr.kind) {
    case Expr::Kind::function:
    case Expr::Kind::prefix:
      return loosest;
    case Expr::Kind::conditional:
      return tight_conditional;
    case Expr::Kind::chain:
      return chain_tightness(static_cast<const Chain&>(expr).links.front().op);
    case Expr::Kind::unary:
      return tight_unary;
    case Expr::Kind::power:
      return tight_power;
    default:
      return tight_postfix;
  }
}

bool is_generator(const Expr& element) {
  return element.kind >= Expr::Kind::generate_for || element.kind == Expr::Kind::prefix;
}

}  // namespace

// Expressions.

void SyntaxPrinter::print(const Expr& expr, int place) {
  const bool needs_parentheses = !style_.has_all_parentheses && tightness(expr) < place;
  if (needs_parentheses) text += '(';
  bare(expr);
  if (needs_parentheses) text += ')';
}

void SyntaxPrinter::bare(const Expr& expr) {
  switch (expr.kind) {
    case Expr::Kind::undef:
      text += "undef";
      return;
    case Expr::Kind::boolean:
      text += static_cast<const Boolean&>(expr).value ? "true" : "false";
      return;
    case Expr::Kind::number:
      text += style_.number(static_cast<const Number&>(expr).value);
      return;
    case Expr::Kind::string:
      text += style_.literal(static_cast<const String&>(expr).value);
      return;
    case Expr::Kind::variable:
      text += static_cast<const Variable&>(expr).name.text();
      return;
    case Expr::Kind::range:
      return range(static_cast<const Range&>(expr));
    case Expr::Kind::list:
      return list(static_cast<const List&>(expr));
    case Expr::Kind::unary:
      text += spelling(static_cast<const Unary&>(expr).op);
      return print(*static_cast<const Unary&>(expr).operand, tight_unary);
    case Expr::Kind::chain:
      return chain(static_cast<const Chain&>(expr));
    case Expr::Kind::power:
      return power(static_cast<const Power&>(expr));
    case Expr::Kind::conditional:
      return conditional(static_cast<const Conditional&>(expr));
    case Expr::Kind::call:
      print(*static_cast<const Call&>(expr).callee, tight_postfix);
      return arguments(static_cast<const Call&>(expr).arguments);
    case Expr::Kind::index: {
      const auto& index = static_cast<const Index&>(expr);
      print(*index.base, tight_postfix);
      text += '[';
      print(*index.index);
      text += ']';
      return;
    }
    case Expr::Kind::member: {
      const auto& member = static_cast<const Member&>(expr);
      // Puts a number in parentheses, since "5.x" would be read as a number followed by a name.
      print(*member.base, member.base->kind == Expr::Kind::number ? tight_postfix + 1 : tight_postfix);
      text += '.' + member.member.text();
      return;
    }
    case Expr::Kind::function: {
      const auto& function = static_cast<const Function&>(expr);
      text += "function";
      parameters(function.parameters);
      return after_head(*function.body, false);
    }
    case Expr::Kind::prefix:
      return prefix(static_cast<const Prefix&>(expr));
    default:
      return generator(expr);
  }
}

void SyntaxPrinter::range(const Range& range) {
  text += '[';
  print(*range.begin);
  text += " : ";
  if (range.step) {
    print(*range.step);
    text += " : ";
  }
  print(*range.end);
  text += ']';
}

void SyntaxPrinter::list(const List& list) {
  text += list.is_tuple ? '(' : '[';
  for (size_t i = 0; i < list.elements.size(); ++i) {
    if (i > 0) text += ", ";
    print(*list.elements[i]);
  }
  text += list.is_tuple ? ')' : ']';
}

void SyntaxPrinter::chain(const Chain& chain) {
  const int operand = chain_tightness(chain.links.front().op) + 1;
  if (style_.has_all_parentheses) text.append(chain.links.size(), '(');
  print(*chain.first, operand);
  for (const Chain::Link& link : chain.links) {
    text += ' ' + std::string(spelling(link.op)) + ' ';
    print(*link.operand, operand);
    if (style_.has_all_parentheses) text += ')';
  }
}

void SyntaxPrinter::power(const Power& power) {
  if (style_.has_all_parentheses) text += '(';
  print(*power.base, tight_postfix);
  text += " ^ ";
  print(*power.exponent, tight_unary);
  if (style_.has_all_parentheses) text += ')';
}

void SyntaxPrinter::conditional(const Conditional& conditional) {
  for (const auto& [condition, value] : conditional.branches) {
    if (style_.has_all_parentheses) text += '(';
    print(*condition, tight_chain);
    text += " ? ";
    print(*value);
    text += " : ";
  }
  print(*conditional.otherwise);
  if (style_.has_all_parentheses) text.append(conditional.branches.size(), ')');
}

void SyntaxPrinter::prefix(const Prefix& prefix) {
  text += spelling(prefix.which);
  arguments(prefix.arguments);
  if (prefix.value) after_head(*prefix.value, false);
}

// Generators of lists.

void SyntaxPrinter::generator(const Expr& expr) {
  switch (expr.kind) {
    case Expr::Kind::generate_for:
      text += std::string("for") + style_.gap;
      arguments(static_cast<const GenerateFor&>(expr).loops);
      return after_head(*static_cast<const GenerateFor&>(expr).element, style_.has_all_parentheses);
    case Expr::Kind::generate_loop:
      return loop(static_cast<const GenerateLoop&>(expr));
    case Expr::Kind::generate_if:
      return choice(static_cast<const GenerateIf&>(expr));
    default:
      text += "each";
      return after_head(*static_cast<const GenerateEach&>(expr).element, style_.has_all_parentheses);
  }
}

void SyntaxPrinter::loop(const GenerateLoop& loop) {
  const std::string separator = std::string(";") + style_.gap;
  text += std::string("for") + style_.gap + '(';
  list_of(loop.init);
  text += separator;
  print(*loop.condition);
  text += separator;
  list_of(loop.next);
  text += ')';
  after_head(*loop.element, false);
}

void SyntaxPrinter::choice(const GenerateIf& choice) {
  text += std::string("if") + style_.gap + '(';
  print(*choice.condition);
  text += ')';
  // An inner "if" without "else" would take this "else".
  after_head(*choice.element, style_.has_all_parentheses || (choice.otherwise && is_generator(*choice.element)));
  if (!choice.otherwise) return;
  text += " else";
  after_head(*choice.otherwise, style_.has_all_parentheses);
}

void SyntaxPrinter::after_head(const Expr& element, bool in_parentheses) {
  text += in_parentheses ? " (" : " ";
  print(element);
  if (in_parentheses) text += ')';
}

void SyntaxPrinter::list_of(const std::vector<Argument>& list) {
  for (size_t i = 0; i < list.size(); ++i) {
    if (i > 0) text += ", ";
    if (list[i].name.symbol) text += list[i].name.text() + " = ";
    print(*list[i].value);
  }
}

void SyntaxPrinter::arguments(const std::vector<Argument>& list) {
  text += '(';
  list_of(list);
  text += ')';
}

void SyntaxPrinter::parameters(const std::vector<Parameter>& list) {
  text += '(';
  for (size_t i = 0; i < list.size(); ++i) {
    if (i > 0) text += ", ";
    text += list[i].name.text();
    if (!list[i].value) continue;
    text += " = ";
    print(*list[i].value);
  }
  text += ')';
}

// Heads of statements.

void SyntaxPrinter::assignment(const Assign& assign) {
  text += assign.name.text() + " = ";
  print(*assign.value);
  text += ";\n";
}

void SyntaxPrinter::definition(const FunctionDef& function) {
  text += "function " + function.name.text();
  parameters(function.parameters);
  text += " = ";
  print(*function.body);
  text += ";\n";
}

void SyntaxPrinter::head(const ModuleDef& module) {
  text += "module " + module.name.text();
  parameters(module.parameters);
}

void SyntaxPrinter::head(const CallStatement& call) {
  text += call.name.text();
  arguments(call.arguments);
}

namespace {

std::string literal(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

constexpr SyntaxStyle style{format_number, literal, false, " "};

class FilePrinter : public SyntaxPrinter {
 public:
  FilePrinter() : SyntaxPrinter(style) {}

  void statements(const std::vector<StatementPtr>& list) {
    for (const StatementPtr& statement : list) this->statement(*statement);
  }

 private:
  void line() { text.append(static_cast<size_t>(indent_) * 2, ' '); }

  void statement(const Statement& statement) {
    line();
    text += statement.modifiers.text();
    switch (statement.kind) {
      case Statement::Kind::assign:
        return assignment(static_cast<const Assign&>(statement));
      case Statement::Kind::function:
        return definition(static_cast<const FunctionDef&>(statement));
      case Statement::Kind::module:
        head(static_cast<const ModuleDef&>(statement));
        braces(static_cast<const ModuleDef&>(statement).body.statements);
        break;
      case Statement::Kind::include: {
        const auto& include = static_cast<const Include&>(statement);
        text += (include.is_use ? "use <" : "include <") + include.path + '>';
        break;
      }
      case Statement::Kind::group:
        braces(static_cast<const Group&>(statement).statements);
        break;
      case Statement::Kind::condition:
        condition(static_cast<const Condition&>(statement));
        break;
      default:
        call(static_cast<const CallStatement&>(statement));
    }
    text += '\n';
  }

  void call(const CallStatement& call) {
    head(call);
    if (call.children.statements.empty() && !call.children.has_braces)
      text += ';';
    else
      braces(call.children.statements);
  }

  void condition(const Condition& condition) {
    for (size_t i = 0; i < condition.branches.size(); ++i) {
      text += i == 0 ? "if (" : " else if (";
      print(*condition.branches[i].first);
      text += ')';
      braces(condition.branches[i].second.statements);
    }
    if (!condition.has_otherwise) return;
    text += " else";
    braces(condition.otherwise.statements);
  }

  void braces(const std::vector<StatementPtr>& list) {
    if (!text.empty() && text.back() != ' ' && text.back() != '\n') text += ' ';
    text += "{\n";
    ++indent_;
    statements(list);
    --indent_;
    line();
    text += '}';
  }

  int indent_ = 0;
};

}  // namespace

std::string print(const File& file) {
  FilePrinter printer;
  printer.statements(file.statements);
  return std::move(printer.text);
}

std::string print(const Expr& expression) {
  SyntaxPrinter printer(style);
  printer.print(expression);
  return std::move(printer.text);
}

}  // namespace ombre::lang
