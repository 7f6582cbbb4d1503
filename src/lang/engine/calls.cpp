// Calls in statements: modules, children, nodes.
#include <algorithm>
#include <cmath>

#include "lang/engine/evaluation_calls.h"
#include "lang/engine/interpreter.h"

namespace ombre::lang {

using ast::CallStatement;

bool Interpreter::knows(const ast::Name& name) {
  const auto found = known_nodes_.find(name.symbol);
  if (found != known_nodes_.end()) return found->second;
  return known_nodes_[name.symbol] = vocabulary_.knows(name.text());
}

void Interpreter::call_other(const CallStatement& statement, const ScopePtr& scope, Nodes& out) {
  if (statement.name.symbol == children_name_) return call_children(statement, scope, out);
  if (!knows(statement.name)) fail_unknown_module(statement.name, *scope);
  call_node(statement, scope, out);
}

void Interpreter::set_counts(const CallStatement& statement, Scope& inner, size_t) {
  inner.set(children_count_name_, static_cast<double>(statement.children.plan.actions.size()));
}

void Interpreter::call_children(const CallStatement& statement, const ScopePtr& scope, Nodes& out) {
  if (!statement.children.statements.empty())
    fail(statement.children.statements.front()->span, "children() takes no children itself");
  make_children(statement.arguments, statement.name.span, scope, out);
}

void Interpreter::make_children(const std::vector<ast::Argument>& arguments, const ast::Span& where,
                                const ScopePtr& scope, Nodes& out) {
  const Children* children = scope->children();
  if (!children) fail(where, "children() means something inside of a module only");
  meter_.count_call();
  const ast::Plan& plan = children->block->plan;
  const std::vector<size_t> chosen = chosen_children(arguments, scope, plan.actions.size());
  if (arguments.empty()) return run_block(*children->block, children->scope, out);
  const ScopePtr inner = make_scope(children->scope, &plan);
  const SpecialsMark mark(*this);
  assign(plan, inner);
  for (const size_t index : chosen) run_action(*plan.actions[index], inner, out);
}

std::vector<size_t> Interpreter::chosen_children(const std::vector<ast::Argument>& arguments, const ScopePtr& scope,
                                                 size_t count) {
  std::vector<size_t> chosen;
  if (arguments.empty()) return chosen;
  if (arguments.size() > 1)
    fail(arguments[1].value->span, "children() takes one argument", "a list chooses several: children([0, 2])");
  const ast::Expr& argument = *arguments.front().value;
  const auto choose = [&](const Value& index) {
    const double* number = index.number();
    if (!number) fail_found(argument.span, "children() needs numbers", index, "children are counted from 0");
    if (*number >= 0 && *number < static_cast<double>(count))
      chosen.push_back(static_cast<size_t>(*number));
    else
      report({Severity::warning, argument.span.range(), "there is no child " + number_text(*number),
              "this call of the module has " + std::to_string(count) + (count == 1 ? " child" : " children") +
                  ", counted from 0"});
  };
  const Value index = eval(argument, scope);
  if (index.list() || index.range())
    for_each(index, argument.span, "", choose);
  else
    choose(index);
  return chosen;
}

void Interpreter::call_node(const CallStatement& statement, const ScopePtr& scope, Nodes& out) {
  Invocation invocation;
  const SpecialsMark mark(*this);
  node_arguments(statement.arguments, scope, invocation, ignore);
  if (const Value* facets = find_special(facets_name_); facets && facets->number())
    invocation.facets = *facets->number();
  else if (facets && invocation.has_own_facets && !facets->is_undef())
    invocation.wrong_facets = describe(*facets);
  if (!statement.children.statements.empty()) {
    const Temporary inside(node_depth_, node_depth_ + 1);
    const size_t failures = failures_;
    run_block(statement.children, scope, invocation.children, &invocation.group_ends);
    invocation.has_wrong_children = failures_ > failures;
  }
  invocation.braces = braces_of(statement);
  invocation.name = statement.name.text();
  invocation.where = statement.name.span.range();
  invocation.whole = statement.whole.range();
  invocation.is_top_level = node_depth_ == 0 && module_calls_.empty();
  invocation.called_from = callers();
  make_node(std::move(invocation), statement.span, out);
}

// Returns the enclosing calls of modules, innermost first.
std::vector<SourceRange> Interpreter::callers() const {
  std::vector<SourceRange> ranges;
  for (size_t i = module_calls_.size(); i > 0 && ranges.size() < most_callers; --i)
    ranges.push_back(module_calls_[i - 1]->whole.range());
  return ranges;
}

void Interpreter::make_node(Invocation invocation, const ast::Span& where, Nodes& out) {
  at_ = where;
  meter_.count_instance();
  Diagnostics found;
  Product node = vocabulary_.make(std::move(invocation), found);
  for (const Diagnostic& diagnostic : found.list()) report(diagnostic);
  if (!node) ++failures_;
  if (node) out.push_back(std::move(node));
}

void Interpreter::assert_true(const std::vector<ast::Argument>& arguments, const ast::Span& where,
                              const ScopePtr& scope) {
  const ast::Expr *condition = nullptr, *message = nullptr;
  for (const ast::Argument& argument : arguments) {
    if (argument.name.symbol ? argument.name.text() == "message" : condition != nullptr)
      message = argument.value.get();
    else
      condition = argument.value.get();
  }
  if (!condition || arguments.size() > 2)
    fail(where, "assert needs a condition, and may have a message", "write assert(condition, message)");
  if (holds(*condition, scope)) return;
  if (!message) fail_assertion(condition->span);
  std::string text;
  append_text(text, eval(*message, scope), false, meter_);
  fail(condition->span, "the assertion does not hold: " + text);
}

}  // namespace ombre::lang
