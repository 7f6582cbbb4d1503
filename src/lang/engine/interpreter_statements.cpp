// Statements: scopes, conditions, loops.
#include "lang/engine/evaluation_loops.h"
#include "lang/engine/interpreter.h"
#include "lang/engine/parser.h"

namespace ombre::lang {

using ast::Statement;

namespace {

// Returns false for statements that make no solid here: echo and assert without children, and those with "%" or "!".
bool makes_solids(const Statement& statement) {
  if (statement.has('%') || statement.has('!')) return false;
  if (statement.kind != Statement::Kind::echo && statement.kind != Statement::Kind::assertion) return true;
  return !static_cast<const ast::CallStatement&>(statement).children.statements.empty();
}

}  // namespace

const ScopePtr& Interpreter::unit_scope(const Unit& unit) {
  const auto found = unit_scopes_.find(&unit);
  if (found != unit_scopes_.end()) return found->second;
  const ScopePtr& scope = unit_scopes_[&unit] = make_scope(ScopePtr(), &unit.plan);
  scope->set_unit(&unit);
  const bool is_main = &unit == &program_.units.front();
  if (is_main)
    for (const auto& [name, value] : overrides_) set_variable({name, {}}, value, *scope, 0);
  assign(unit.plan, scope, is_main);
  return scope;
}

void Interpreter::assign(const ast::Plan& plan, const ScopePtr& scope, bool is_main) {
  const size_t specials_from = specials_.size();
  for (const ast::Assign* assignment : plan.assignments) {
    if (is_main && overrides_.count(assignment->name.symbol)) continue;
    Value value = Broken{};
    try {
      value = eval(*assignment->value, scope);
    } catch (const Stopped&) {  // code that reads the variable later fails without a diagnostic
    }
    set_variable(assignment->name, std::move(value), *scope, specials_from);
  }
}

void Interpreter::run_block(const ast::Block& block, const ScopePtr& outer, Nodes& out, std::vector<size_t>* ends) {
  if (block.plan.defines_nothing()) return run_actions(block.plan, outer, out, ends);
  const ScopePtr scope = make_scope(outer, &block.plan);
  const SpecialsMark mark(*this);
  assign(block.plan, scope, false);
  run_actions(block.plan, scope, out, ends);
}

void Interpreter::run_actions(const ast::Plan& plan, const ScopePtr& scope, Nodes& out, std::vector<size_t>* ends) {
  const auto reader = options_.threads > 1 ? ReadAhead::start(plan.actions, *program_.names) : nullptr;
  const Reading reading(reader_, reader.get());
  for (size_t n = 0; n < plan.actions.size(); ++n) {
    if (reader) reader->go_to(n);
    run_action(*plan.actions[n], scope, out);
    if (ends && makes_solids(*plan.actions[n])) ends->push_back(out.size());
  }
}

// Runs a statement. A failure does not stop the statements after it, except for an assertion, on which they rely.
void Interpreter::run_action(const Statement& statement, const ScopePtr& scope, Nodes& out) {
  try {
    execute(statement, scope, out);
  } catch (const Stopped&) {
    ++failures_;
    if (statement.kind == Statement::Kind::assertion) throw;
  }
}

void Interpreter::execute(const Statement& statement, const ScopePtr& scope, Nodes& out) {
  const Level level(*this, statement.span, heavy);
  if (statement.modifiers.empty())
    dispatch(statement, scope, out);
  else
    execute_modified(statement, scope, out);
}

void Interpreter::execute_modified(const Statement& statement, const ScopePtr& scope, Nodes& out) {
  if (!statement.has('%') && !statement.has('!')) return dispatch(statement, scope, out);
  Nodes nodes;
  dispatch(statement, scope, nodes);
  if (!statement.has('!')) return;
  has_roots_ = true;
  roots_.insert(roots_.end(), nodes.begin(), nodes.end());
}

void Interpreter::dispatch(const Statement& statement, const ScopePtr& scope, Nodes& out) {
  if (statement.kind == Statement::Kind::condition)
    return run_condition(static_cast<const ast::Condition&>(statement), scope, out);
  if (statement.kind == Statement::Kind::deferred)
    return run_deferred(static_cast<const ast::Deferred&>(statement), scope, out);
  const auto& named = static_cast<const ast::CallStatement&>(statement);
  switch (statement.kind) {
    case Statement::Kind::loop:
      return run_loop(named, 0, scope, out);
    case Statement::Kind::let:
      return run_let(named, scope, out);
    case Statement::Kind::assertion:
      assert_true(named.arguments, named.whole, scope);
      return run_block(named.children, scope, out);
    case Statement::Kind::echo:
      echo(named.arguments, scope);
      return run_block(named.children, scope, out);
    default:
      return call(named, scope, out);
  }
}

// Runs a deferred call. Values must not point into the statement after it, since it is freed.
void Interpreter::run_deferred(const ast::Deferred& statement, const ScopePtr& scope, Nodes& out) {
  if (const Statement* known = reader_ ? reader_->call(statement) : nullptr) return dispatch(*known, scope, out);
  const ast::StatementPtr call = read(statement, *program_.names);
  dispatch(*call, scope, out);
}

void Interpreter::run_condition(const ast::Condition& statement, const ScopePtr& scope, Nodes& out) {
  for (const auto& [condition, block] : statement.branches)
    if (holds(*condition, scope)) return run_block(block, scope, out);
  run_block(statement.otherwise, scope, out);
}

// Runs a loop over its variables, starting with number `variable`.
void Interpreter::run_loop(const ast::CallStatement& statement, size_t variable, const ScopePtr& scope, Nodes& out) {
  if (variable == statement.arguments.size()) return run_block(statement.children, scope, out);
  const Level level(*this, statement.whole, heavy);
  for_each_scope(statement.arguments[variable], statement.span, scope,
                 [&](const ScopePtr& inner) { run_loop(statement, variable + 1, inner, out); });
}

void Interpreter::run_let(const ast::CallStatement& statement, const ScopePtr& scope, Nodes& out) {
  const ScopePtr inner = make_scope(scope);
  const SpecialsMark mark(*this);
  bind_let(statement.arguments, inner, mark.size());
  run_block(statement.children, inner, out);
}

}  // namespace ombre::lang
