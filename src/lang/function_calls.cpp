// Calls in expressions, with what they may end in: conditions, let, further calls.
#include <algorithm>

#include "base/assert.h"
#include "lang/interpreter.h"

namespace ombre::lang {

using ast::Expr;

Value Interpreter::eval_tail(const Expr& start, const ScopePtr& outer) {
  const Expr* expr = &start;
  ScopePtr scope = outer;
  const SpecialsMark mark(*this);
  for (;;) {
    meter_.spend();
    switch (expr->kind) {
      case Expr::Kind::conditional:
        expr = choose(static_cast<const ast::Conditional&>(*expr), scope);
        break;
      case Expr::Kind::prefix:
        expr = enter_prefix(static_cast<const ast::Prefix&>(*expr), scope, mark.size());
        if (!expr) return {};
        break;
      case Expr::Kind::call: {
        const auto& call = static_cast<const ast::Call&>(*expr);
        Callee callee;
        if (const Builtin* builtin = resolve(call, scope, callee)) return call_builtin(*builtin, call, scope);
        ASSERT(callee.parameters && callee.body);
        ScopePtr inner = make_scope(callee.scope);
        bind(*callee.parameters, call.arguments, scope, inner, call.callee->span, mark.size());
        scope = std::move(inner);
        expr = callee.body;
        break;
      }
      default:
        return eval(*expr, scope);
    }
  }
}

const Expr* Interpreter::choose(const ast::Conditional& conditional, const ScopePtr& scope) {
  for (const auto& [condition, value] : conditional.branches)
    if (is_true(eval(*condition, scope))) return value.get();
  return conditional.otherwise.get();
}

// What follows let, assert or echo, or null when nothing does.
const Expr* Interpreter::enter_prefix(const ast::Prefix& prefix, ScopePtr& scope, size_t specials_from) {
  switch (prefix.which) {
    case ast::PrefixKind::let:
      scope = make_scope(scope);
      bind_let(prefix.arguments, scope, specials_from);
      break;
    case ast::PrefixKind::assertion:
      assert_true(prefix.arguments, prefix.span, scope);
      break;
    case ast::PrefixKind::echo:
      echo(prefix.arguments, scope);
      break;
  }
  return prefix.value.get();
}

// One after the other, so that each sees those before it.
void Interpreter::bind_let(const std::vector<ast::Argument>& arguments, const ScopePtr& scope, size_t specials_from) {
  for (const ast::Argument& argument : arguments)
    set_variable(argument.name, eval(*argument.value, scope), *scope, specials_from);
}

bool Interpreter::find_function(Symbol name, const ScopePtr& scope, Callee& callee) {
  const auto found = [&](const ast::FunctionDef& function, const ScopePtr& home) {
    callee = {&function.parameters, function.body.get(), home};
    return true;
  };
  for (const ScopePtr* at = &scope; *at; at = &(*at)->parent()) {
    if ((*at)->plan())
      if (const ast::FunctionDef* function = (*at)->plan()->function(name)) return found(*function, *at);
    if (const Value* value = (*at)->own(name)) {
      if (value->is_broken()) throw Failure{};
      if (const Closure* closure = value->closure()) {
        callee = {&closure->function->parameters, closure->function->body.get(), closure->scope};
        return true;
      }
    }
    if (!(*at)->unit()) continue;
    for (const Unit* used : (*at)->unit()->uses)
      if (const ast::FunctionDef* function = used->plan.function(name)) return found(*function, unit_scope(*used));
  }
  return false;
}

// A builtin, or null and the callee.
const Builtin* Interpreter::resolve(const ast::Call& call, const ScopePtr& scope, Callee& callee) {
  if (call.callee->kind == Expr::Kind::variable) {
    const ast::Name& name = static_cast<const ast::Variable&>(*call.callee).name;
    if (find_function(name.symbol, scope, callee)) return nullptr;
    const auto builtin = builtins_.find(name.symbol);
    if (builtin != builtins_.end()) return builtin->second;
    if (!name.is_special() || !find_special(name.symbol)) fail_unknown_function(name, *scope);
  }
  const Value value = eval(*call.callee, scope);
  const Closure* closure = value.closure();
  if (!closure) fail_found(call.callee->span, "only a function can be called", value);
  callee = {&closure->function->parameters, closure->function->body.get(), closure->scope};
  return nullptr;
}

Value Interpreter::call_builtin(const Builtin& builtin, const ast::Call& call, const ScopePtr& scope) {
  const std::string_view name = builtin.name;
  // The one function that may ask about what does not exist.
  if (name == "is_undef" && call.arguments.size() == 1 && call.arguments[0].value->kind == Expr::Kind::variable) {
    const Value* value =
        quiet_variable(static_cast<const ast::Variable&>(*call.arguments[0].value).name.symbol, *scope);
    return !value || value->is_undef();
  }
  std::vector<const Expr*> places;
  const BuiltinCall arguments(builtin.name, builtin_arguments(builtin, call, scope, places), meter_);
  at_ = call.span;
  try {
    return builtin.call(arguments);
  } catch (const BadArgument& bad) {
    const bool has_place = bad.index < places.size() && places[bad.index];
    fail(has_place ? places[bad.index]->span : call.span, bad.message, bad.hint);
  }
}

std::vector<Value> Interpreter::builtin_arguments(const Builtin& builtin, const ast::Call& call, const ScopePtr& scope,
                                                  std::vector<const Expr*>& places) {
  std::vector<Value> values;
  size_t position = 0;
  for (const ast::Argument& argument : call.arguments) {
    const size_t place = builtin_place(builtin, argument, position);
    if (!argument.name.symbol) ++position;
    if (values.size() <= place) {
      values.resize(place + 1);
      places.resize(place + 1);
    }
    values[place] = eval(*argument.value, scope);
    places[place] = argument.value.get();
  }
  for (size_t i = 0; i < builtin.required; ++i)
    if (i >= places.size() || !places[i]) fail_builtin(call.span, builtin, "an argument is missing for ", "()");
  return values;
}

size_t Interpreter::builtin_place(const Builtin& builtin, const ast::Argument& argument, size_t position) {
  if (!argument.name.symbol) {
    if (position >= builtin.parameters.size() && !builtin.is_variadic)
      fail_builtin(argument.value->span, builtin, "too many arguments for ", "()");
    return position;
  }
  for (size_t i = 0; i < builtin.parameters.size(); ++i)
    if (argument.name.text() == builtin.parameters[i]) return i;
  fail_builtin(argument.name.span, builtin, "", "() has no parameter \"" + argument.name.text() + '"');
}

}  // namespace ombre::lang
