// Calls in expressions, and the conditionals, let and further calls with which they may end.
#include <algorithm>

#include "base/system/assert.h"
#include "lang/engine/interpreter.h"

namespace ombre::lang {

using ast::Expr;

Value Interpreter::eval_tail(const Expr& start, const ScopePtr& outer) {
  const Expr* expr = &start;
  ScopePtr scope = outer;
  const SpecialsMark mark(*this);
  for (;;) {
    meter_.spend();
    switch (expr->kind) {
      case Expr::Kind::conditional: {
        Value chosen;
        expr = choose(static_cast<const ast::Conditional&>(*expr), scope, chosen);
        if (!expr) return chosen;
        break;
      }
      case Expr::Kind::prefix:
        expr = enter_prefix(static_cast<const ast::Prefix&>(*expr), scope, mark.size());
        if (!expr) return {};
        break;
      case Expr::Kind::call: {
        const auto& call = static_cast<const ast::Call&>(*expr);
        Callee callee;
        if (const Builtin* builtin = resolve(call, scope, callee)) return call_builtin(*builtin, call, scope);
        if (!callee.body) return call_value_node(call, scope);
        ASSERT(callee.parameters);
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

// Returns the expression to evaluate, or null if the condition varies in space; then `chosen` is set to a value that
// selects at each point.
const Expr* Interpreter::choose(const ast::Conditional& conditional, const ScopePtr& scope, Value& chosen) {
  for (size_t n = 0; n < conditional.branches.size(); ++n) {
    const auto& [condition, value] = conditional.branches[n];
    const Value decision = eval(*condition, scope);
    if (decision.object()) {
      const Value yes = eval(*value, scope);
      chosen = choice(decision, yes, otherwise(conditional, n + 1, scope), condition->span);
      return nullptr;
    }
    if (is_true(decision)) return value.get();
  }
  return conditional.otherwise.get();
}

// Returns the value of a conditional, starting with branch `first`.
Value Interpreter::otherwise(const ast::Conditional& conditional, size_t first, const ScopePtr& scope) {
  if (first == conditional.branches.size()) return eval(*conditional.otherwise, scope);
  const auto& [condition, value] = conditional.branches[first];
  const Level level(*this, condition->span, heavy);
  const Value decision = eval(*condition, scope);
  if (!decision.object()) return is_true(decision) ? eval(*value, scope) : otherwise(conditional, first + 1, scope);
  const Value yes = eval(*value, scope);
  return choice(decision, yes, otherwise(conditional, first + 1, scope), condition->span);
}

// Returns a value that selects one of two at each point, element by element for lists.
Value Interpreter::choice(const Value& condition, const Value& yes, const Value& no, const ast::Span& where) {
  const List *a = yes.list(), *b = no.list();
  if (a && b && a->items.size() == b->items.size()) {
    ListBuilder result(meter_);
    for (size_t i = 0; i < a->items.size(); ++i) result.push(choice(condition, a->items[i], b->items[i], where));
    return result.finish();
  }
  const Value operands[] = {condition, yes, no};
  const auto made = condition.object()->apply("?:", operands, meter_);
  if (!made)
    fail(where, "this condition varies in space, and cannot choose between " + describe(yes) + " and " + describe(no),
         "give numbers on both sides of the colon, or materials, or lists of them");
  return *made;
}

// Returns the expression after let, assert or echo, or null if there is none.
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

// Assigns the variables one after the other, so that each can use those before it.
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

// Returns a builtin function, or null and sets `callee`, which stays empty for a node that gives values.
const Builtin* Interpreter::resolve(const ast::Call& call, const ScopePtr& scope, Callee& callee) {
  if (call.callee->kind == Expr::Kind::variable) {
    const ast::Name& name = static_cast<const ast::Variable&>(*call.callee).name;
    if (find_function(name.symbol, scope, callee)) return nullptr;
    const auto builtin = builtins_.find(name.symbol);
    if (builtin != builtins_.end()) return builtin->second;
    if (vocabulary_.gives_value(name.text())) return nullptr;
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
  // is_undef is the only function whose argument may be undefined.
  if (name == "is_undef" && call.arguments.size() == 1 && call.arguments[0].value->kind == Expr::Kind::variable) {
    const Value* value =
        quiet_variable(static_cast<const ast::Variable&>(*call.arguments[0].value).name.symbol, *scope);
    return !value || value->is_undef();
  }
  std::vector<const Expr*> places;
  std::vector<Value> values = builtin_arguments(builtin, call, scope, places);
  at_ = call.span;
  if (const auto made = result_of_objects(builtin.name, values)) return *made;
  const BuiltinCall arguments(builtin.name, std::move(values), meter_);
  try {
    return builtin.call(arguments);
  } catch (const BadArgument& bad) {
    const bool has_place = bad.index < places.size() && places[bad.index];
    fail(has_place ? places[bad.index]->span : call.span, bad.message, bad.hint);
  }
}

// Applies a function to numbers and objects, given as arguments or as one list.
std::optional<Value> Interpreter::result_of_objects(std::string_view function, const std::vector<Value>& arguments) {
  const List* list = arguments.size() == 1 ? arguments[0].list() : nullptr;
  const std::span<const Value> operands = list ? std::span(list->items) : std::span(arguments);
  const Object* object = first_object(operands);
  const bool takes_list = function == "min" || function == "max" || function == "norm";
  if (!object || (list && !takes_list)) return std::nullopt;
  return object->apply(function, operands, meter_);
}

Value Interpreter::call_value_node(const ast::Call& call, const ScopePtr& scope) {
  Invocation invocation;
  const SpecialsMark mark(*this);
  node_arguments(call.arguments, scope, invocation);
  invocation.name = static_cast<const ast::Variable&>(*call.callee).name.text();
  invocation.where = call.callee->span.range();
  invocation.whole = call.span.range();
  for (size_t i = module_calls_.size(); i > 0 && invocation.called_from.size() < most_callers; --i)
    invocation.called_from.push_back(module_calls_[i - 1]->whole.range());
  at_ = call.span;
  meter_.count_instance();
  Diagnostics found;
  const auto value = vocabulary_.value(std::move(invocation), found, meter_);
  for (const Diagnostic& diagnostic : found.list()) report(diagnostic);
  if (!value) throw Failure{};
  return *value;
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
