// Calls in expressions, the conditionals, let and further calls with which they may end, and arguments of calls.
#pragma once

#include <algorithm>

#include "lang/engine/argument_check.h"
#include "lang/engine/evaluation_loops.h"

namespace ombre::lang {

template <class Language, class Product>
Value Evaluation<Language, Product>::eval_tail(const ast::Expr& start, const ScopePtr& outer) {
  const ast::Expr* expr = &start;
  ScopePtr scope = outer;
  const SpecialsMark mark(*this);
  typename Language::EnteredCalls entered;
  try {
    for (;;) {
      meter_.spend();
      switch (expr->kind) {
        case ast::Expr::Kind::conditional: {
          Value chosen;
          expr = choose(static_cast<const ast::Conditional&>(*expr), scope, chosen);
          if (!expr) return chosen;
          break;
        }
        case ast::Expr::Kind::prefix:
          expr = enter_prefix(static_cast<const ast::Prefix&>(*expr), scope, mark.size());
          if (!expr) return {};
          break;
        case ast::Expr::Kind::call: {
          const auto& call = static_cast<const ast::Call&>(*expr);
          Callee callee;
          if (!find_callee(call, scope, callee)) return self().call_other(call, scope);
          self().check_depth(call, entered);
          ScopePtr inner = make_scope(callee.scope);
          if (callee.used) self().enter(*callee.used, mark.size());
          bind(*callee.parameters, call.arguments, scope, callee.scope, inner, place(call.span, call.callee->span),
               mark.size());
          if (callee.declaration) check_arguments(*callee.declaration, call.arguments, *inner);
          entered.add(call, *callee.body);
          scope = std::move(inner);
          expr = callee.body;
          break;
        }
        default:
          return eval(*expr, scope);
      }
    }
  } catch (const Stopped&) {
    self().trace(entered);
    throw;
  } catch (const LimitReached&) {
    self().stop_if_recursive(entered);
    throw;
  }
}

// Returns the expression after let, assert or echo, or null if there is none.
template <class Language, class Product>
const ast::Expr* Evaluation<Language, Product>::enter_prefix(const ast::Prefix& prefix, ScopePtr& scope,
                                                             size_t specials_from) {
  switch (prefix.which) {
    case ast::PrefixKind::let:
      scope = make_scope(scope);
      bind_let(prefix.arguments, scope, specials_from);
      break;
    case ast::PrefixKind::assertion:
      self().assert_true(prefix.arguments, prefix.span, scope);
      break;
    case ast::PrefixKind::echo:
      echo(prefix.arguments, scope);
      break;
  }
  return prefix.value.get();
}

// Finds the function or closure of the script. Returns false for other names.
template <class Language, class Product>
bool Evaluation<Language, Product>::find_callee(const ast::Call& call, const ScopePtr& scope, Callee& callee) {
  if (call.callee->kind == ast::Expr::Kind::variable)
    return find_function(static_cast<const ast::Variable&>(*call.callee).name.symbol, scope, callee);
  const Value value = eval(*call.callee, scope);
  const Closure* closure = value.closure();
  if (closure)
    callee = {&closure->function->parameters, closure->function->body.get(), closure->scope};
  else
    self().replace_callee(call, value, scope, callee);
  return true;
}

template <class Language, class Product>
bool Evaluation<Language, Product>::find_function(Symbol name, const ScopePtr& scope, Callee& callee) {
  const auto is_closure = [&](const Value* value) {
    if (value && value->is_broken()) throw Stopped{};
    const Closure* closure = value ? value->closure() : nullptr;
    if (closure) callee = {&closure->function->parameters, closure->function->body.get(), closure->scope};
    return closure != nullptr;
  };
  const auto is_defined = [&](const ast::Plan* plan, const ScopePtr& home, const Unit* used) {
    const ast::FunctionDef* function = plan ? plan->function(name) : nullptr;
    if (function) callee = {&function->parameters, function->body.get(), home, used, function->declaration.get()};
    return function != nullptr;
  };
  if (name->front() == '$') {
    if (!Language::rules.calls_specials) return false;
    if (is_closure(find_special(name))) return true;
  }
  for (const ScopePtr* at = &scope; *at; at = &(*at)->parent()) {
    if (Language::rules.prefers_variables && is_closure((*at)->own(name))) return true;
    if (is_defined((*at)->plan(), *at, nullptr)) return true;
    if (!Language::rules.prefers_variables && is_closure((*at)->own(name))) return true;
    if (const Unit* used = find_used(**at, [&](const Unit& unit) { return unit.plan.function(name) != nullptr; }))
      return is_defined(&used->plan, self().unit_scope(*used), used);
  }
  return false;
}

// Only is_undef may be called with a variable that does not exist. Returns nothing for other calls.
template <class Language, class Product>
std::optional<bool> Evaluation<Language, Product>::tests_variable(std::string_view function, const ast::Call& call,
                                                                  const Scope& scope) {
  if (function != "is_undef" || call.arguments.size() != 1) return std::nullopt;
  const ast::Expr& argument = *call.arguments[0].value;
  if (argument.kind != ast::Expr::Kind::variable) return std::nullopt;
  const Value* value = find_variable(static_cast<const ast::Variable&>(argument).name.symbol, scope);
  return !value || value->is_undef();
}

// Applies a function to numbers and objects, given as arguments or as one list. Returns nothing if there are none.
template <class Language, class Product>
std::optional<Value> Evaluation<Language, Product>::result_of_objects(std::string_view function,
                                                                      std::span<const Value> arguments) {
  const List* list = arguments.size() == 1 ? arguments[0].list() : nullptr;
  const bool takes_list = function == "min" || function == "max" || function == "norm";
  if (list && !takes_list) return std::nullopt;
  const std::span<const Value> operands = list ? std::span(list->items) : arguments;
  const Object* object = first_object(operands);
  return object ? object->apply(function, operands, meter_) : std::nullopt;
}

template <class Language, class Product>
void Evaluation<Language, Product>::bind(const std::vector<ast::Parameter>& parameters,
                                         const std::vector<ast::Argument>& arguments, const ScopePtr& caller,
                                         const ScopePtr& home, const ScopePtr& into, const ast::Span& callee,
                                         size_t specials_from) {
  constexpr bool specials_last = Language::rules.arguments_set_specials_last;
  into->reserve(parameters.size());
  size_t position = 0;
  for (const ast::Argument& argument : arguments) {
    Symbol name = argument.name.symbol;
    if (!name) {
      if (position == parameters.size()) self().report_too_many(argument, callee, parameters);
      if (position++ >= parameters.size()) continue;
      name = parameters[position - 1].name.symbol;
    } else {
      const auto is_it = [&](const ast::Parameter& parameter) { return parameter.name.symbol == name; };
      if (name->front() != '$' && std::ranges::none_of(parameters, is_it))
        self().report_parameter(argument.name, callee, parameters);
    }
    if (into->own(name)) self().report_twice(argument, name, callee);
    Value value = eval(*argument.value, caller);
    if (!specials_last && name->front() == '$') set_special(name, value, specials_from);
    into->set(name, std::move(value));
  }
  for (const ast::Parameter& parameter : parameters) {
    if (into->own(parameter.name.symbol)) continue;
    // A special parameter without a value keeps that of the caller.
    if (parameter.name.is_special() && !parameter.value) continue;
    Value value;
    if (parameter.value) value = eval(*parameter.value, Language::rules.defaults_see_parameters ? into : home);
    if (parameter.name.is_special()) set_special(parameter.name.symbol, value, specials_from);
    into->set(parameter.name.symbol, std::move(value));
  }
  if (!specials_last) return;
  for (const auto& [name, value] : into->variables())
    if (name->front() == '$') set_special(name, value, specials_from);
}

// Compares the arguments of a call with the declaration of the operator.
template <class Language, class Product>
void Evaluation<Language, Product>::check_arguments(const Declaration& declaration,
                                                    const std::vector<ast::Argument>& arguments, const Scope& bound) {
  const auto& parameters = declaration.parameters;
  size_t position = 0;
  for (const ast::Argument& argument : arguments) {
    const auto is_it = [&](const DeclaredParameter& one) { return one.name == argument.name.text(); };
    auto parameter = parameters.end();
    if (argument.name.symbol)
      parameter = std::ranges::find_if(parameters, is_it);
    else if (position < parameters.size())
      parameter = parameters.begin() + static_cast<std::ptrdiff_t>(position++);
    if (parameter == parameters.end()) continue;
    const Value* value = bound.own(symbol(parameter->name));
    std::string mismatch = value ? mismatch_of(*parameter, *value) : "";
    if (mismatch.empty() && value && value->text() && names_material(*parameter))
      mismatch = self().mismatch_of_material(value->text()->text);
    if (!mismatch.empty())
      self().stop_at_argument(argument.value->span, declaration.name + ": " + parameter->name + ": " + mismatch);
  }
}

// Assigns the variables one after the other, so that each can use those before it.
template <class Language, class Product>
void Evaluation<Language, Product>::bind_let(const std::vector<ast::Argument>& arguments, const ScopePtr& scope,
                                             size_t specials_from) {
  for (size_t n = 0; n < arguments.size(); ++n) {
    Value value = eval(*arguments[n].value, scope);
    if (!self().ignores(arguments, n, value)) set_variable(arguments[n].name, std::move(value), *scope, specials_from);
  }
}

template <class Language, class Product>
void Evaluation<Language, Product>::echo(const std::vector<ast::Argument>& arguments, const ScopePtr& scope) {
  std::string text;
  for (const ast::Argument& argument : arguments) {
    if (!text.empty()) text += ", ";
    if (argument.name.symbol) text += argument.name.text() + " = ";
    self().append(text, eval(*argument.value, scope));
  }
  self().print(std::move(text));
}

// Conversion of values to arguments of nodes: plain data with source positions.

// `seen` is called with each argument and its value.
template <class Language, class Product>
template <class Seen>
void Evaluation<Language, Product>::node_arguments(const std::vector<ast::Argument>& arguments, const ScopePtr& scope,
                                                   Invocation& invocation, const Seen& seen) {
  const size_t specials_from = specials_.size();
  invocation.variable = [&scope](const std::string& name) { return named_value(name, *scope); };
  invocation.arguments.reserve(arguments.size());
  uint64_t bytes = 0;
  for (const ast::Argument& argument : arguments) {
    const Value value = eval(*argument.value, scope);
    const ast::Span& span = argument.value->span;
    seen(argument, value);
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

// Returns the number or object in the script's variable of this name, which formulas may use.
template <class Language, class Product>
std::optional<Data> Evaluation<Language, Product>::named_value(const std::string& name, const Scope& scope) {
  const Value* value = scope.find_text(name);
  if (value && value->number()) return Data(*value->number());
  return value && value->object() ? std::optional(value->object()->data()) : std::nullopt;
}

template <class Language, class Product>
Invocation::Braces Evaluation<Language, Product>::braces_of(const ast::CallStatement& statement) {
  if (!statement.children.statements.empty()) return Invocation::Braces::filled;
  return statement.children.has_braces ? Invocation::Braces::empty : Invocation::Braces::none;
}

template <class Language, class Product>
Data Evaluation<Language, Product>::to_data(const Value& value, const SourceRange& where, const ast::Span& argument) {
  meter_.spend();
  if (const double* number = value.number()) return {*number, where};
  if (const Text* text = value.text()) {
    argument_bytes_ += text->text.size();
    meter_.check_text(argument_bytes_);
    // A literal string has a position of its own, even if the value was passed on through variables.
    const bool is_literal = text->origin && text->origin->is_plain;
    return {text->text, is_literal ? text->origin->inside().range() : where};
  }
  if (const bool* boolean = value.boolean()) return {*boolean, where};
  if (value.list() || value.range()) return to_list(value, where, argument);
  if (value.closure()) self().stop_at_function(argument);
  if (const Record* record = value.record()) {
    DataMembers members;
    for (const auto& [name, member] : record->members) members.emplace_back(name, to_data(member, where, argument));
    return {std::move(members), where};
  }
  Data data = value.object() ? value.object()->data() : Data();
  data.where = where;
  return data;
}

template <class Language, class Product>
Data Evaluation<Language, Product>::to_list(const Value& value, const SourceRange& where, const ast::Span& argument) {
  DataList items;
  if (value.range())
    for_each(value, argument, "", [&](const Value& item) { items.emplace_back(*item.number(), where); });
  const List* list = value.list();
  if (list) items.reserve(list->items.size());
  for (size_t i = 0; list && i < list->items.size(); ++i) {
    const ast::Expr* written = list->origin ? list->origin->elements[i].get() : nullptr;
    items.push_back(to_data(list->items[i], written ? written->span.range() : where, argument));
  }
  return {std::move(items), where};
}

}  // namespace ombre::lang
