// Calls in statements: modules, children, nodes.
#include <algorithm>
#include <cmath>

#include "lang/engine/evaluation_loops.h"
#include "lang/engine/interpreter.h"

namespace ombre::lang {

using ast::CallStatement;

bool Interpreter::knows(const ast::Name& name) {
  const auto found = known_nodes_.find(name.symbol);
  if (found != known_nodes_.end()) return found->second;
  return known_nodes_[name.symbol] = vocabulary_.knows(name.text());
}

std::pair<const ast::ModuleDef*, ScopePtr> Interpreter::find_module(Symbol name, const ScopePtr& scope) {
  for (const ScopePtr* at = &scope; *at; at = &(*at)->parent()) {
    if ((*at)->plan())
      if (const ast::ModuleDef* module = (*at)->plan()->module(name)) return {module, *at};
    if (!(*at)->unit()) continue;
    for (const Unit* used : (*at)->unit()->uses)
      if (const ast::ModuleDef* module = used->plan.module(name)) return {module, unit_scope(*used)};
  }
  return {};
}

void Interpreter::call(const CallStatement& statement, const ScopePtr& scope, Nodes& out) {
  const auto [module, home] = find_module(statement.name.symbol, scope);
  if (module) return call_module(*module, home, statement, scope, out);
  if (statement.name.symbol == children_name_) return call_children(statement, scope, out);
  if (!knows(statement.name)) fail_unknown_module(statement.name, *scope);
  call_node(statement, scope, out);
}

void Interpreter::call_module(const ast::ModuleDef& module, const ScopePtr& home, const CallStatement& statement,
                              const ScopePtr& scope, Nodes& out) {
  meter_.count_call();
  const Children children{&statement.children, scope};
  const ScopePtr inner = make_scope(home, &module.body.plan);
  const SpecialsMark mark(*this);
  inner->set_children(&children);
  bind(module.parameters, statement.arguments, scope, home, inner, statement.name.span, mark.size());
  inner->set(children_count_name_, static_cast<double>(statement.children.plan.actions.size()));

  struct Entered {
    std::vector<const CallStatement*>& calls;
    ~Entered() { calls.pop_back(); }
  };
  module_calls_.push_back(&statement);
  const Entered entered{module_calls_};
  assign(module.body.plan, inner, false);
  run_actions(module.body.plan, inner, out);
}

void Interpreter::call_children(const CallStatement& statement, const ScopePtr& scope, Nodes& out) {
  const Children* children = scope->children();
  if (!children) fail(statement.name.span, "children() means something inside of a module only");
  meter_.count_call();
  if (!statement.children.statements.empty())
    fail(statement.children.statements.front()->span, "children() takes no children itself");
  const ast::Plan& plan = children->block->plan;
  const std::vector<size_t> chosen = chosen_children(statement, scope, plan.actions.size());
  if (statement.arguments.empty()) return run_block(*children->block, children->scope, out);
  const ScopePtr inner = make_scope(children->scope, &plan);
  const SpecialsMark mark(*this);
  assign(plan, inner, false);
  for (const size_t index : chosen) run_action(*plan.actions[index], inner, out);
}

std::vector<size_t> Interpreter::chosen_children(const CallStatement& statement, const ScopePtr& scope, size_t count) {
  std::vector<size_t> chosen;
  if (statement.arguments.empty()) return chosen;
  if (statement.arguments.size() > 1)
    fail(statement.arguments[1].value->span, "children() takes one argument",
         "a list chooses several: children([0, 2])");
  const ast::Expr& argument = *statement.arguments.front().value;
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
  node_arguments(statement.arguments, scope, invocation);
  if (const Value* facets = find_special(facets_name_); facets && facets->number())
    invocation.facets = *facets->number();
  else if (facets && invocation.has_own_facets && !facets->is_undef())
    invocation.wrong_facets = describe(*facets);
  if (!statement.children.statements.empty()) {
    struct Inside {
      int& depth;
      ~Inside() { --depth; }
    };
    ++node_depth_;
    const Inside inside{node_depth_};
    const size_t failures = failures_;
    run_block(statement.children, scope, invocation.children, &invocation.group_ends);
    invocation.has_wrong_children = failures_ > failures;
  }
  invocation.braces = !statement.children.statements.empty() ? Invocation::Braces::filled
                      : statement.children.has_braces        ? Invocation::Braces::empty
                                                             : Invocation::Braces::none;
  invocation.name = statement.name.text();
  invocation.where = statement.name.span.range();
  invocation.whole = statement.whole.range();
  invocation.is_top_level = node_depth_ == 0 && module_calls_.empty();
  for (size_t i = module_calls_.size(); i > 0 && invocation.called_from.size() < most_callers; --i)
    invocation.called_from.push_back(module_calls_[i - 1]->whole.range());
  make_node(std::move(invocation), statement.span, out);
}

namespace {

// Returns the number or object in the script's variable of this name, which formulas may use.
std::optional<Data> named_value(const std::string& name, const Scope& scope) {
  const Value* value = scope.find_text(name);
  if (value && value->number()) return Data(*value->number());
  return value && value->object() ? std::optional(value->object()->data()) : std::nullopt;
}

}  // namespace

void Interpreter::node_arguments(const std::vector<ast::Argument>& arguments, const ScopePtr& scope,
                                 Invocation& invocation) {
  const size_t specials_from = specials_.size();
  invocation.variable = [&scope](const std::string& name) { return named_value(name, *scope); };
  invocation.arguments.reserve(arguments.size());
  uint64_t bytes = 0;
  for (const ast::Argument& argument : arguments) {
    const Value value = eval(*argument.value, scope);
    const ast::Span& span = argument.value->span;
    if (argument.name.symbol && argument.name.is_special()) {
      set_special(argument.name.symbol, value, specials_from);  // makes the variable visible to the children
      invocation.has_own_facets |= argument.name.symbol == facets_name_;
      continue;
    }
    Argument& result = invocation.arguments.emplace_back();
    if (argument.name.symbol) {
      result.name = argument.name.text();
      result.name_where = argument.name.span.range();
    }
    argument_bytes_ = bytes;  // evaluating the argument may have overwritten it
    result.value = to_data(value, span.range(), span);
    bytes = argument_bytes_;
  }
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
