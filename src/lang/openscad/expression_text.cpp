// Prints expressions and statements as OpenSCAD does, for functions as values, failed assertions and .ast files.
#include "lang/openscad/value_text.h"
#include "lang/syntax/ast_print.h"

namespace ombre::lang::openscad {
namespace {

constexpr SyntaxStyle style{number_text, literal_of, true, ""};

class PlanPrinter : public SyntaxPrinter {
 public:
  PlanPrinter() : SyntaxPrinter(style) {}

  void scope(const ast::Plan& plan, int indent) {
    for (const ast::FunctionDef* function : plan.functions) {
      tabs(indent);
      definition(*function);
    }
    for (const ast::ModuleDef* module : plan.modules) {
      tabs(indent);
      head(*module);
      braces(module->body.plan, indent);
    }
    for (const ast::Assign* assign : plan.assignments) {
      tabs(indent);
      assignment(*assign);
    }
    for (const ast::Statement* action : plan.actions) {
      tabs(indent);
      statement(*action, indent);
    }
  }

 private:
  void tabs(int indent) { text.append(static_cast<size_t>(indent), '\t'); }

  void braces(const ast::Plan& plan, int indent) {
    text += " {\n";
    scope(plan, indent + 1);
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
      braces(plan, indent);
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
        print(*choice.branches[i].first);
        text += ')';
        block(choice.branches[i].second, indent);
      }
      if (!choice.has_otherwise) return;
      tabs(indent);
      text += "else";
      return block(choice.otherwise, indent);
    }
    const auto& call = static_cast<const ast::CallStatement&>(statement);
    head(call);
    block(call.children, indent);
  }
};

}  // namespace

std::string expression_text(const ast::Expr& expression) {
  SyntaxPrinter printer(style);
  printer.print(expression);
  return std::move(printer.text);
}

std::string scope_text(const ast::Plan& plan) {
  PlanPrinter printer;
  printer.scope(plan, 0);
  return std::move(printer.text);
}

}  // namespace ombre::lang::openscad
