#include "lang/engine/ast_print.h"

#include "base/text/text.h"

namespace ombre::lang {
namespace {

using namespace ast;

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

class Printer {
 public:
  std::string text;

  void statements(const std::vector<StatementPtr>& list) {
    for (const StatementPtr& statement : list) print(*statement);
  }

  void print(const Expr& expr, int place = loosest) {
    const bool needs_parentheses = tightness(expr) < place;
    if (needs_parentheses) text += '(';
    bare(expr);
    if (needs_parentheses) text += ')';
  }

 private:
  void line() { text.append(static_cast<size_t>(indent_) * 2, ' '); }

  void print(const Statement& statement) {
    line();
    text += statement.modifiers.text();
    switch (statement.kind) {
      case Statement::Kind::assign: {
        const auto& assign = static_cast<const Assign&>(statement);
        text += assign.name.text() + " = ";
        print(*assign.value);
        text += ";\n";
        return;
      }
      case Statement::Kind::function: {
        const auto& function = static_cast<const FunctionDef&>(statement);
        text += "function " + function.name.text();
        parameters(function.parameters);
        text += " = ";
        print(*function.body);
        text += ";\n";
        return;
      }
      case Statement::Kind::module: {
        const auto& module = static_cast<const ModuleDef&>(statement);
        text += "module " + module.name.text();
        parameters(module.parameters);
        braces(module.body.statements);
        text += '\n';
        return;
      }
      case Statement::Kind::include: {
        const auto& include = static_cast<const Include&>(statement);
        text += (include.is_use ? "use <" : "include <") + include.path + ">\n";
        return;
      }
      case Statement::Kind::group:
        braces(static_cast<const Group&>(statement).statements);
        text += '\n';
        return;
      case Statement::Kind::condition:
        return condition(static_cast<const Condition&>(statement));
      default:
        return call(static_cast<const CallStatement&>(statement));
    }
  }

  void call(const CallStatement& call) {
    text += call.name.text();
    arguments(call.arguments);
    if (call.children.statements.empty() && !call.children.has_braces)
      text += ';';
    else
      braces(call.children.statements);
    text += '\n';
  }

  void condition(const Condition& condition) {
    for (size_t i = 0; i < condition.branches.size(); ++i) {
      text += i == 0 ? "if (" : " else if (";
      print(*condition.branches[i].first);
      text += ')';
      braces(condition.branches[i].second.statements);
    }
    if (condition.has_otherwise) {
      text += " else";
      braces(condition.otherwise.statements);
    }
    text += '\n';
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

  void bare(const Expr& expr) {
    switch (expr.kind) {
      case Expr::Kind::undef:
        text += "undef";
        return;
      case Expr::Kind::boolean:
        text += static_cast<const Boolean&>(expr).value ? "true" : "false";
        return;
      case Expr::Kind::number:
        text += format_number(static_cast<const Number&>(expr).value);
        return;
      case Expr::Kind::string:
        return string(static_cast<const String&>(expr).value);
      case Expr::Kind::variable:
        text += static_cast<const Variable&>(expr).name.text();
        return;
      case Expr::Kind::range:
        return range(static_cast<const Range&>(expr));
      case Expr::Kind::list:
        return list(static_cast<const List&>(expr));
      case Expr::Kind::unary:
        return unary(static_cast<const Unary&>(expr));
      case Expr::Kind::chain:
        return chain(static_cast<const Chain&>(expr));
      case Expr::Kind::power:
        return power(static_cast<const Power&>(expr));
      case Expr::Kind::conditional:
        return conditional(static_cast<const Conditional&>(expr));
      case Expr::Kind::call: {
        const auto& call = static_cast<const Call&>(expr);
        print(*call.callee, tight_postfix);
        arguments(call.arguments);
        return;
      }
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
        text += ' ';
        print(*function.body);
        return;
      }
      case Expr::Kind::prefix:
        return prefix(static_cast<const Prefix&>(expr));
      default:
        return generator(expr);
    }
  }

  void string(const std::string& value) {
    text += '"';
    for (const char c : value) {
      if (c == '"' || c == '\\') text += '\\';
      text += c;
    }
    text += '"';
  }

  void range(const Range& range) {
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

  void list(const List& list) {
    text += list.is_tuple ? '(' : '[';
    for (size_t i = 0; i < list.elements.size(); ++i) {
      if (i > 0) text += ", ";
      print(*list.elements[i]);
    }
    text += list.is_tuple ? ')' : ']';
  }

  void unary(const Unary& unary) {
    text += spelling(unary.op);
    print(*unary.operand, tight_unary);
  }

  void chain(const Chain& chain) {
    const int operand = chain_tightness(chain.links.front().op) + 1;
    print(*chain.first, operand);
    for (const Chain::Link& link : chain.links) {
      text += ' ' + std::string(spelling(link.op)) + ' ';
      print(*link.operand, operand);
    }
  }

  void power(const Power& power) {
    print(*power.base, tight_postfix);
    text += " ^ ";
    print(*power.exponent, tight_unary);
  }

  void conditional(const Conditional& conditional) {
    for (const auto& [condition, value] : conditional.branches) {
      print(*condition, tight_chain);
      text += " ? ";
      print(*value);
      text += " : ";
    }
    print(*conditional.otherwise);
  }

  void prefix(const Prefix& prefix) {
    text += spelling(prefix.which);
    arguments(prefix.arguments);
    if (!prefix.value) return;
    text += ' ';
    print(*prefix.value);
  }

  void generator(const Expr& expr) {
    switch (expr.kind) {
      case Expr::Kind::generate_for: {
        const auto& loop = static_cast<const GenerateFor&>(expr);
        text += "for ";
        arguments(loop.loops);
        return after_head(*loop.element);
      }
      case Expr::Kind::generate_loop: {
        const auto& loop = static_cast<const GenerateLoop&>(expr);
        text += "for (";
        argument_list(loop.init);
        text += "; ";
        print(*loop.condition);
        text += "; ";
        argument_list(loop.next);
        text += ')';
        return after_head(*loop.element);
      }
      case Expr::Kind::generate_if: {
        const auto& choice = static_cast<const GenerateIf&>(expr);
        text += "if (";
        print(*choice.condition);
        text += ')';
        // An inner "if" without "else" would take this "else".
        const bool needs_parentheses = choice.otherwise && (choice.element->kind >= Expr::Kind::generate_for ||
                                                            choice.element->kind == Expr::Kind::prefix);
        text += needs_parentheses ? " (" : " ";
        print(*choice.element);
        if (needs_parentheses) text += ')';
        if (!choice.otherwise) return;
        text += " else";
        return after_head(*choice.otherwise);
      }
      default:
        text += "each";
        return after_head(*static_cast<const GenerateEach&>(expr).element);
    }
  }

  void after_head(const Expr& element) {
    text += ' ';
    print(element);
  }

  void argument_list(const std::vector<Argument>& list) {
    for (size_t i = 0; i < list.size(); ++i) {
      if (i > 0) text += ", ";
      if (list[i].name.symbol) text += list[i].name.text() + " = ";
      print(*list[i].value);
    }
  }

  void arguments(const std::vector<Argument>& list) {
    text += '(';
    argument_list(list);
    text += ')';
  }

  void parameters(const std::vector<Parameter>& list) {
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

  int indent_ = 0;
};

}  // namespace

std::string print(const File& file) {
  Printer printer;
  printer.statements(file.statements);
  return std::move(printer.text);
}

std::string print(const Expr& expression) {
  Printer printer;
  printer.print(expression);
  return std::move(printer.text);
}

}  // namespace ombre::lang
