// Calls of builtin functions, and of nodes that give values.
#include "lang/engine/evaluation_calls.h"
#include "lang/engine/interpreter.h"

namespace ombre::lang {

using ast::Expr;

void Interpreter::replace_callee(const ast::Call& call, const Value& value, const ScopePtr&, Callee&) {
  fail_found(call.callee->span, "only a function can be called", value);
}

Value Interpreter::call_other(const ast::Call& call, const ScopePtr& scope) {
  const ast::Name& name = static_cast<const ast::Variable&>(*call.callee).name;
  const auto builtin = builtins_.find(name.symbol);
  if (builtin != builtins_.end()) return call_builtin(*builtin->second, call, scope);
  if (name.symbol == children_name_) return children_value(call, scope);
  if (vocabulary_.gives_value(name.text())) return call_value_node(call, scope);
  if (!name.is_special() || !find_special(name.symbol)) fail_unknown_function(name, *scope);
  fail_found(call.callee->span, "only a function can be called", eval(*call.callee, scope));
}

Value Interpreter::call_builtin(const Builtin& builtin, const ast::Call& call, const ScopePtr& scope) {
  if (const auto is_undefined = tests_variable(builtin.name, call, *scope)) return *is_undefined;
  std::vector<const Expr*> places;
  std::vector<Value> values = builtin_arguments(builtin, call, scope, places);
  at_ = call.span;
  if (const auto made = result_of_objects(builtin.name, values)) return *made;
  std::vector<std::string> names;
  for (const ast::Argument& argument : call.arguments)
    if (builtin.names_members) names.push_back(argument.name.symbol ? argument.name.text() : "");
  const BuiltinCall arguments(builtin.name, std::move(values), meter_, std::move(names));
  try {
    return builtin.call(arguments);
  } catch (const BadArgument& bad) {
    const bool has_place = bad.index < places.size() && places[bad.index];
    fail(has_place ? places[bad.index]->span : call.span, bad.message, bad.hint);
  }
}

// Returns what children() makes as one solid, on which values can be measured.
Value Interpreter::children_value(const ast::Call& call, const ScopePtr& scope) {
  Nodes made;
  make_children(call.arguments, call.callee->span, scope, made);
  Diagnostics found;
  const auto value = vocabulary_.solid(std::move(made), call.span.range(), found, meter_);
  for (const Diagnostic& diagnostic : found.list()) report(diagnostic);
  if (!value) throw Stopped{};
  return *value;
}

Value Interpreter::call_value_node(const ast::Call& call, const ScopePtr& scope) {
  Invocation invocation;
  const SpecialsMark mark(*this);
  node_arguments(call.arguments, scope, invocation, ignore);
  invocation.name = static_cast<const ast::Variable&>(*call.callee).name.text();
  invocation.where = call.callee->span.range();
  invocation.whole = call.span.range();
  invocation.called_from = callers();
  at_ = call.span;
  meter_.count_instance();
  Diagnostics found;
  const auto value = vocabulary_.value(std::move(invocation), found, meter_);
  for (const Diagnostic& diagnostic : found.list()) report(diagnostic);
  if (!value) throw Stopped{};
  return *value;
}

std::vector<Value> Interpreter::builtin_arguments(const Builtin& builtin, const ast::Call& call, const ScopePtr& scope,
                                                  std::vector<const Expr*>& places) {
  std::vector<Value> values;
  size_t position = 0;
  for (const ast::Argument& argument : call.arguments) {
    const size_t place = builtin_place(builtin, argument, position);
    if (!argument.name.symbol || builtin.names_members) ++position;
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
  if (!argument.name.symbol || builtin.names_members) {
    if (position >= builtin.parameters.size() && !builtin.is_variadic)
      fail_builtin(argument.value->span, builtin, "too many arguments for ", "()");
    return position;
  }
  for (size_t i = 0; i < builtin.parameters.size(); ++i)
    if (argument.name.text() == builtin.parameters[i]) return i;
  fail_builtin(argument.name.span, builtin, "", "() has no parameter \"" + argument.name.text() + '"');
}

}  // namespace ombre::lang
