// Statements: scopes, loops, calls of modules.
#pragma once

#include "lang/engine/evaluation_loops.h"

namespace ombre::lang {

template <class Language, class Product>
const ScopePtr& Evaluation<Language, Product>::unit_scope(const Unit& unit) {
  const auto found = unit_scopes_.find(&unit);
  if (found != unit_scopes_.end()) return found->second;
  const ScopePtr& scope = unit_scopes_[&unit] = make_scope(ScopePtr(), &unit.plan);
  scope->set_unit(&unit);
  self().begin(unit, *scope);
  const size_t specials_before = specials_.size();
  assign(unit.plan, scope);
  self().end(unit, specials_before);
  return scope;
}

template <class Language, class Product>
void Evaluation<Language, Product>::assign(const ast::Plan& plan, const ScopePtr& scope) {
  const size_t specials_from = specials_.size();
  for (const ast::Assign* assignment : plan.assignments)
    if (!self().is_overridden(*assignment, *scope))
      set_variable(assignment->name, self().assigned(*assignment, scope), *scope, specials_from);
}

template <class Language, class Product>
void Evaluation<Language, Product>::dispatch(const ast::Statement& statement, const ScopePtr& scope, Products& out) {
  using Kind = ast::Statement::Kind;
  if (statement.kind == Kind::deferred)
    return self().run_deferred(static_cast<const ast::Deferred&>(statement), scope, out);
  try {
    if (statement.kind == Kind::condition)
      return self().run_condition(static_cast<const ast::Condition&>(statement), scope, out);
    const auto& named = static_cast<const ast::CallStatement&>(statement);
    switch (statement.kind) {
      case Kind::loop:
        return self().run_loops(named, scope, out);
      case Kind::let:
        return run_let(named, scope, out);
      case Kind::assertion:
        self().assert_true(named.arguments, named.whole, scope);
        return self().run_inside(named, scope, out);
      case Kind::echo:
        echo(named.arguments, scope);
        return self().run_inside(named, scope, out);
      default:
        return call(named, scope, out);
    }
  } catch (const Stopped&) {
    self().trace(statement);
    throw;
  }
}

// Runs a loop over its variables, starting with number `variable`.
template <class Language, class Product>
void Evaluation<Language, Product>::run_loop(const ast::CallStatement& statement, size_t variable,
                                             const ScopePtr& scope, Products& out) {
  if (variable == statement.arguments.size()) return run_block(statement.children, scope, out);
  const auto level = deeper(statement.whole, Language::rules.call_levels);
  for_each_scope(statement.arguments[variable], statement.span, scope,
                 [&](const ScopePtr& inner) { run_loop(statement, variable + 1, inner, out); });
}

template <class Language, class Product>
void Evaluation<Language, Product>::run_let(const ast::CallStatement& statement, const ScopePtr& scope, Products& out) {
  const ScopePtr inner = make_scope(scope);
  const SpecialsMark mark(*this);
  bind_let(statement.arguments, inner, mark.size());
  self().group(statement.span, out, [&](Products& inside) { run_block(statement.children, inner, inside); });
}

template <class Language, class Product>
void Evaluation<Language, Product>::call(const ast::CallStatement& statement, const ScopePtr& scope, Products& out) {
  const Symbol name = statement.name.symbol;
  for (const ScopePtr* at = &scope; *at; at = &(*at)->parent()) {
    const ast::Plan* plan = (*at)->plan();
    if (const ast::ModuleDef* module = plan ? plan->module(name) : nullptr)
      return call_module(*module, *at, nullptr, statement, scope, out);
    if (const Unit* used = find_used(**at, [&](const Unit& unit) { return unit.plan.module(name) != nullptr; }))
      return call_module(*used->plan.module(name), unit_scope(*used), used, statement, scope, out);
  }
  self().call_other(statement, scope, out);
}

template <class Language, class Product>
void Evaluation<Language, Product>::call_module(const ast::ModuleDef& module, const ScopePtr& home, const Unit* used,
                                                const ast::CallStatement& statement, const ScopePtr& scope,
                                                Products& out) {
  self().check_depth(module);
  meter_.count_call();
  const Children children{&statement.children, scope};
  const ScopePtr inner = make_scope(home, &module.body.plan);
  const SpecialsMark mark(*this);
  inner->set_children(&children);
  if (used) self().enter(*used, mark.size());
  try {
    bind(module.parameters, statement.arguments, scope, home, inner, place(statement.span, statement.name.span),
         mark.size());
    if (module.declaration) check_arguments(*module.declaration, statement.arguments, *inner);
  } catch (const LimitReached&) {
    self().stop_if_recursive(module);
    throw;
  }
  self().set_counts(statement, *inner, mark.size());
  self().check_assignments(module);

  struct Entered {
    std::vector<const ast::CallStatement*>& calls;
    ~Entered() { calls.pop_back(); }
  };
  module_calls_.push_back(&statement);
  const Entered entered{module_calls_};
  self().group(statement.span, out, [&](Products& inside) {
    assign(module.body.plan, inner);
    self().run_actions(module.body.plan, inner, inside);
  });
}

}  // namespace ombre::lang
