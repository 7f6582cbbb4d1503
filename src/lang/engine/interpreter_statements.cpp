// Statements of .vcad scripts, which make nodes.
#include "lang/engine/interpreter.h"
#include "lang/syntax/parser.h"

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

// Sets the variables of the command line.
void Interpreter::begin(const Unit& unit, Scope& scope) {
  if (&unit != &program_.units.front()) return;
  for (const auto& [name, value] : overrides_) set_variable({name, {}}, value, scope, 0);
}

bool Interpreter::is_overridden(const ast::Assign& assignment, const Scope& scope) const {
  return scope.unit() == &program_.units.front() && overrides_.count(assignment.name.symbol) > 0;
}

// Code that reads a variable whose assignment failed fails without a diagnostic.
Value Interpreter::assigned(const ast::Assign& assignment, const ScopePtr& scope) {
  try {
    return computed(*assignment.value, eval(*assignment.value, scope));
  } catch (const Stopped&) {
    return Broken{};
  }
}

void Interpreter::tell(const ast::Expr& expr, const Value& value) const {
  if (const Object* object = value.object()) return options_.computed(expr.span.range(), *object);
  if (!value.record()) return;
  for (const auto& [name, member] : value.record()->members)
    if (const Object* object = member.object()) return options_.computed(expr.span.range(), *object);
}

void Interpreter::run_actions(const ast::Plan& plan, const ScopePtr& scope, Nodes& out, std::vector<size_t>* ends) {
  const auto reader = options_.threads > 1 ? ReadAhead::start(plan.actions, *program_.names) : nullptr;
  const Temporary reading(reader_, reader.get());
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
  const auto level = deeper(statement.span, heavy);
  const size_t before = out.size();
  if (statement.modifiers.empty())
    dispatch(statement, scope, out);
  else
    execute_modified(statement, scope, out);
  if (options_.made && out.size() > before) options_.made(statement.span.range(), std::span(out).subspan(before));
}

void Interpreter::execute_modified(const Statement& statement, const ScopePtr& scope, Nodes& out) {
  if (!statement.has('%') && !statement.has('!')) return dispatch(statement, scope, out);
  Nodes nodes;
  dispatch(statement, scope, nodes);
  if (!statement.has('!')) return;
  has_roots_ = true;
  roots_.insert(roots_.end(), nodes.begin(), nodes.end());
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

}  // namespace ombre::lang
