// Prints expressions and statements as OpenSCAD does, for functions as values, failed assertions and .ast files.
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {
namespace {

using ast::Expr;

class SyntaxPrinter {
 public:
  std::string text;

  void expression(const Expr& expr) {
    switch (expr.kind) {
      case Expr::Kind::undef:
        text += "undef";
        return;
      case Expr::Kind::boolean:
        text += static_cast<const ast::Boolean&>(expr).value ? "true" : "false";
        return;
      case Expr::Kind::number:
        text += number_text(static_cast<const ast::Number&>(expr).value);
        return;
      case Expr::Kind::string:
        return string(static_cast<const ast::String&>(expr).value);
      case Expr::Kind::variable:
        text += static_cast<const ast::Variable&>(expr).name.text();
        return;
      case Expr::Kind::range:
        return range(static_cast<const ast::Range&>(expr));
      case Expr::Kind::list:
        return list(static_cast<const ast::List&>(expr));
      case Expr::Kind::unary:
        text += ast::spelling(static_cast<const ast::Unary&>(expr).op);
        return expression(*static_cast<const ast::Unary&>(expr).operand);
      case Expr::Kind::chain:
        return chain(static_cast<const ast::Chain&>(expr));
      case Expr::Kind::power:
        return power(static_cast<const ast::Power&>(expr));
      case Expr::Kind::conditional:
        return conditional(static_cast<const ast::Conditional&>(expr));
      default:
        return compound(expr);
    }
  }

  void arguments(const std::vector<ast::Argument>& arguments) {
    for (size_t i = 0; i < arguments.size(); ++i) {
      if (i > 0) text += ", ";
      if (arguments[i].name.symbol) text += arguments[i].name.text() + " = ";
      expression(*arguments[i].value);
    }
  }

  void parameters(const std::vector<ast::Parameter>& parameters) {
    for (size_t i = 0; i < parameters.size(); ++i) {
      if (i > 0) text += ", ";
      text += parameters[i].name.text();
      if (!parameters[i].value) continue;
      text += " = ";
      expression(*parameters[i].value);
    }
  }

  void scope(const ast::Plan& plan, int indent) {
    for (const ast::FunctionDef* function : plan.functions) definition(*function, indent);
    for (const ast::ModuleDef* module : plan.modules) definition(*module, indent);
    for (const ast::Assign* assignment : plan.assignments) {
      tabs(indent);
      text += assignment->name.text() + " = ";
      expression(*assignment->value);
      text += ";\n";
    }
    for (const ast::Statement* action : plan.actions) {
      tabs(indent);
      statement(*action, indent);
    }
  }

 private:
  void tabs(int indent) { text.append(static_cast<size_t>(indent), '\t'); }

  // Prints expressions that contain calls or loops.
  void compound(const Expr& expr) {
    switch (expr.kind) {
      case Expr::Kind::call: {
        const auto& call = static_cast<const ast::Call&>(expr);
        expression(*call.callee);
        text += '(';
        arguments(call.arguments);
        text += ')';
        return;
      }
      case Expr::Kind::index:
        expression(*static_cast<const ast::Index&>(expr).base);
        text += '[';
        expression(*static_cast<const ast::Index&>(expr).index);
        text += ']';
        return;
      case Expr::Kind::member:
        expression(*static_cast<const ast::Member&>(expr).base);
        text += '.' + static_cast<const ast::Member&>(expr).member.text();
        return;
      case Expr::Kind::function:
        text += "function(";
        parameters(static_cast<const ast::Function&>(expr).parameters);
        text += ") ";
        return expression(*static_cast<const ast::Function&>(expr).body);
      case Expr::Kind::prefix:
        return prefix(static_cast<const ast::Prefix&>(expr));
      default:
        return generator(expr);
    }
  }

  void generator(const Expr& expr) {
    switch (expr.kind) {
      case Expr::Kind::generate_for: {
        const auto& loop = static_cast<const ast::GenerateFor&>(expr);
        text += "for(";
        arguments(loop.loops);
        text += ") ";
        return in_parentheses(*loop.element);
      }
      case Expr::Kind::generate_loop: {
        const auto& loop = static_cast<const ast::GenerateLoop&>(expr);
        text += "for(";
        arguments(loop.init);
        text += ';';
        expression(*loop.condition);
        text += ';';
        arguments(loop.next);
        text += ") ";
        return expression(*loop.element);
      }
      case Expr::Kind::generate_if: {
        const auto& choice = static_cast<const ast::GenerateIf&>(expr);
        text += "if(";
        expression(*choice.condition);
        text += ") ";
        in_parentheses(*choice.element);
        if (!choice.otherwise) return;
        text += " else ";
        return in_parentheses(*choice.otherwise);
      }
      default:
        text += "each ";
        return in_parentheses(*static_cast<const ast::GenerateEach&>(expr).element);
    }
  }

  void in_parentheses(const Expr& expr) {
    text += '(';
    expression(expr);
    text += ')';
  }

  void string(const std::string& value) {
    text += '"';
    for (const char c : value) {
      if (c == '\n')
        text += "\\n";
      else if (c == '\t')
        text += "\\t";
      else if (c == '\r')
        text += "\\r";
      else if (c == '"' || c == '\\')
        text += std::string("\\") + c;
      else
        text += c;
    }
    text += '"';
  }

  void range(const ast::Range& range) {
    text += '[';
    expression(*range.begin);
    if (range.step) {
      text += " : ";
      expression(*range.step);
    }
    text += " : ";
    expression(*range.end);
    text += ']';
  }

  void list(const ast::List& list) {
    text += '[';
    for (size_t i = 0; i < list.elements.size(); ++i) {
      if (i > 0) text += ", ";
      expression(*list.elements[i]);
    }
    text += ']';
  }

  void chain(const ast::Chain& chain) {
    text.append(chain.links.size(), '(');
    expression(*chain.first);
    for (const ast::Chain::Link& link : chain.links) {
      text += std::string(" ") + ast::spelling(link.op) + ' ';
      expression(*link.operand);
      text += ')';
    }
  }

  void power(const ast::Power& power) {
    text += '(';
    expression(*power.base);
    text += " ^ ";
    expression(*power.exponent);
    text += ')';
  }

  void conditional(const ast::Conditional& conditional) {
    for (const auto& [condition, value] : conditional.branches) {
      text += '(';
      expression(*condition);
      text += " ? ";
      expression(*value);
      text += " : ";
    }
    expression(*conditional.otherwise);
    text.append(conditional.branches.size(), ')');
  }

  void prefix(const ast::Prefix& prefix) {
    text += std::string(ast::spelling(prefix.which)) + '(';
    arguments(prefix.arguments);
    text += ')';
    if (!prefix.value) return;
    text += ' ';
    expression(*prefix.value);
  }

  void definition(const ast::FunctionDef& function, int indent) {
    tabs(indent);
    text += "function " + function.name.text() + '(';
    parameters(function.parameters);
    text += ") = ";
    expression(*function.body);
    text += ";\n";
  }

  void definition(const ast::ModuleDef& module, int indent) {
    tabs(indent);
    text += "module " + module.name.text() + '(';
    parameters(module.parameters);
    text += ") {\n";
    scope(module.body.plan, indent + 1);
    tabs(indent);
    text += "}\n";
  }

  void block(const ast::Block& block, int indent) {
    const ast::Plan& plan = block.plan;
    if (plan.defines_nothing() && plan.actions.empty()) {
      text += ";\n";
    } else if (plan.defines_nothing() && plan.actions.size() == 1) {
      text += ' ';
      statement(*plan.actions.front(), indent);
    } else {
      text += " {\n";
      scope(plan, indent + 1);
      tabs(indent);
      text += "}\n";
    }
  }

  void statement(const ast::Statement& statement, int indent) {
    if (statement.kind == ast::Statement::Kind::deferred) {
      const ast::Span& span = statement.span;
      text += std::string((*span.source)->text().substr(span.begin, span.end - span.begin)) + '\n';
      return;
    }
    if (statement.kind == ast::Statement::Kind::condition) {
      const auto& choice = static_cast<const ast::Condition&>(statement);
      for (size_t i = 0; i < choice.branches.size(); ++i) {
        if (i > 0) tabs(indent);
        text += i > 0 ? "else if(" : "if(";
        expression(*choice.branches[i].first);
        text += ')';
        block(choice.branches[i].second, indent);
      }
      if (!choice.has_otherwise) return;
      tabs(indent);
      text += "else";
      return block(choice.otherwise, indent);
    }
    const auto& call = static_cast<const ast::CallStatement&>(statement);
    text += call.name.text() + '(';
    arguments(call.arguments);
    text += ')';
    block(call.children, indent);
  }
};

}  // namespace

std::string expression_text(const Expr& expression) {
  SyntaxPrinter printer;
  printer.expression(expression);
  return std::move(printer.text);
}

std::string scope_text(const ast::Plan& plan) {
  SyntaxPrinter printer;
  printer.scope(plan, 0);
  return std::move(printer.text);
}

}  // namespace ombre::lang::openscad
