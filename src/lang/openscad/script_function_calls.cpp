// Calls in expressions, and the conditionals, let and further calls with which they may end.
#include <algorithm>

#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {

using ast::Expr;

namespace {

std::string callee_name(const ast::Call& call) {
  return call.callee->kind == Expr::Kind::variable ? static_cast<const ast::Variable&>(*call.callee).name.text()
                                                   : expression_text(*call.callee);
}

}  // namespace

// Evaluates an expression. A function that ends with a call continues in this loop and needs no further depth.
Value Evaluator::eval_tail(const Expr& start, const ScopePtr& outer) {
  const Expr* expr = &start;
  ScopePtr scope = outer;
  const SpecialsMark mark(*this);
  // The calls that were entered, and the body of the last one. A function that calls itself at its end counts once.
  const ast::Call* first = nullptr;
  std::vector<const ast::Call*> others;
  const Expr* body = nullptr;
  try {
    for (;;) {
      meter_.spend();
      switch (expr->kind) {
        case Expr::Kind::conditional: {
          const auto& conditional = static_cast<const ast::Conditional&>(*expr);
          size_t branch = 0;
          for (; branch < conditional.branches.size(); ++branch) {
            const Value condition = eval(*conditional.branches[branch].first, scope);
            if (condition.object()) return choice(conditional, branch, condition, scope);
            if (truth(condition)) break;
          }
          expr = branch == conditional.branches.size() ? conditional.otherwise.get()
                                                       : conditional.branches[branch].second.get();
          break;
        }
        case Expr::Kind::prefix:
          expr = enter_prefix(static_cast<const ast::Prefix&>(*expr), scope, mark.size());
          if (!expr) return {};
          break;
        case Expr::Kind::call: {
          const auto& call = static_cast<const ast::Call&>(*expr);
          Callee callee;
          if (!find_function(call, scope, callee)) return call_builtin(call, scope);
          if (depth_ > options_.limits.depth - spare_levels)
            stop("Recursion detected calling function '" + callee_name(call) + '\'', call.span);
          ScopePtr inner = make_scope(callee.scope);
          if (callee.used)
            for (const auto& [name, value] : unit_specials_[callee.used]) set_special(name, value, mark.size());
          bind(*callee.parameters, call.arguments, scope, callee.scope, inner, call.span, mark.size());
          if (!first)
            first = &call;
          else if (callee.body != body)
            others.push_back(&call);
          scope = std::move(inner);
          expr = body = callee.body;
          break;
        }
        default:
          return eval(*expr, scope);
      }
    }
  } catch (const Stopped&) {
    // Clang 14 cannot read std::views::reverse. NOLINTNEXTLINE(modernize-loop-convert)
    for (auto call = others.rbegin(); call != others.rend(); ++call) trace(callee_name(**call), (*call)->span);
    if (first) trace(callee_name(*first), first->span);
    throw;
  }
}

// Returns the expression after let, assert or echo, or null if there is none.
const Expr* Evaluator::enter_prefix(const ast::Prefix& prefix, ScopePtr& scope, size_t specials_from) {
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

// Assigns the variables one after the other, so that each can use those before it. A repeated name is ignored.
void Evaluator::bind_let(const std::vector<ast::Argument>& arguments, const ScopePtr& scope, size_t specials_from) {
  for (size_t n = 0; n < arguments.size(); ++n) {
    const ast::Name& name = arguments[n].name;
    Value value = eval(*arguments[n].value, scope);
    const auto is_it = [&](const ast::Argument& before) { return name.symbol && before.name.symbol == name.symbol; };
    if (std::any_of(arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(n), is_it))
      warn("Ignoring duplicate variable assignment " + name.text() + " = " + value_text(value, true, meter_),
           arguments[n].value->span);
    else
      set_variable(name, std::move(value), *scope, specials_from);
  }
}

bool Evaluator::find_named_function(Symbol name, const ScopePtr& scope, Callee& callee) {
  const auto is_closure = [&](const Value* value) {
    const Closure* closure = value ? value->closure() : nullptr;
    if (closure) callee = {&closure->function->parameters, closure->function->body.get(), closure->scope, nullptr};
    return closure != nullptr;
  };
  if (name->front() == '$' && is_closure(find_special(name))) return true;
  for (const ScopePtr* at = &scope; *at; at = &(*at)->parent()) {
    if (is_closure((*at)->own(name))) return true;
    if ((*at)->plan()) {
      if (const ast::FunctionDef* function = (*at)->plan()->function(name)) {
        callee = {&function->parameters, function->body.get(), *at, nullptr};
        return true;
      }
    }
    if (!(*at)->unit()) continue;
    // Clang 14 cannot read std::views::reverse. NOLINTNEXTLINE(modernize-loop-convert)
    for (auto used = (*at)->unit()->uses.rbegin(); used != (*at)->unit()->uses.rend(); ++used) {
      if (const ast::FunctionDef* function = (*used)->plan.function(name)) {
        callee = {&function->parameters, function->body.get(), unit_scope(**used), *used};
        return true;
      }
    }
  }
  return false;
}

bool Evaluator::find_function(const ast::Call& call, const ScopePtr& scope, Callee& callee) {
  if (call.callee->kind == Expr::Kind::variable)
    return find_named_function(static_cast<const ast::Variable&>(*call.callee).name.symbol, scope, callee);
  const Value value = eval(*call.callee, scope);
  const Closure* closure = value.closure();
  if (!closure) {
    warn(std::string("Can't call function on ") + type_name(value), call.span);
    static const ast::Undef nothing(ast::Span{});
    static const std::vector<ast::Parameter> none;
    callee = {&none, &nothing, scope, nullptr};
    return true;
  }
  callee = {&closure->function->parameters, closure->function->body.get(), closure->scope, nullptr};
  return true;
}

Value Evaluator::call_builtin(const ast::Call& call, const ScopePtr& scope) {
  const ast::Name& name = static_cast<const ast::Variable&>(*call.callee).name;
  const auto found = functions_.find(name.symbol);
  if (found == functions_.end() && gives_value(name, *scope)) return value_of_word(call, scope);
  if (found == functions_.end()) {
    warn("Ignoring unknown function '" + name.text() + '\'', call.span);
    return {};
  }
  // is_undef is the only function whose argument may be undefined.
  if (name.text() == "is_undef" && call.arguments.size() == 1 &&
      call.arguments[0].value->kind == Expr::Kind::variable) {
    const Value* value = find_variable(static_cast<const ast::Variable&>(*call.arguments[0].value).name.symbol, *scope);
    return !value || value->is_undef();
  }
  std::vector<Value> arguments;
  arguments.reserve(call.arguments.size());
  for (const ast::Argument& argument : call.arguments) arguments.push_back(eval(*argument.value, scope));
  at_ = call.span;
  if (auto made = of_objects(found->second.name, arguments)) return *made;
  Problems problems;
  const FunctionCall made{found->second.name, std::move(arguments), meter_, problems, module_names_, random_, call};
  Value result = found->second.call(made);
  warn_all(problems, call.span);
  return result;
}

void Evaluator::bind(const std::vector<ast::Parameter>& parameters, const std::vector<ast::Argument>& arguments,
                     const ScopePtr& caller, const ScopePtr& home, const ScopePtr& into, const ast::Span& where,
                     size_t specials_from) {
  into->reserve(parameters.size());
  std::vector<Symbol> specials;  // set at the end, so that arguments and defaults do not see them
  size_t position = 0;
  bool has_too_many = false;
  for (const ast::Argument& argument : arguments) {
    Symbol name = argument.name.symbol;
    if (!name && position >= parameters.size()) {
      if (!std::exchange(has_too_many, true)) warn("Too many unnamed arguments supplied", where);
      continue;
    }
    if (!name) {
      name = parameters[position++].name.symbol;
    } else {
      const auto is_it = [&](const ast::Parameter& parameter) { return parameter.name.symbol == name; };
      if (name->front() != '$' && std::ranges::none_of(parameters, is_it))
        warn("variable " + *name + " not specified as parameter", where);
    }
    if (into->own(name)) warn("argument " + *name + " supplied more than once", where);
    if (name->front() == '$') specials.push_back(name);
    into->set(name, eval(*argument.value, caller));
  }
  for (const ast::Parameter& parameter : parameters) {
    if (into->own(parameter.name.symbol)) continue;
    if (!parameter.value) {
      if (!parameter.name.is_special()) into->set(parameter.name.symbol, Value());
      continue;
    }
    Value value = eval(*parameter.value, home);
    if (parameter.name.is_special()) set_special(parameter.name.symbol, value, specials_from);
    into->set(parameter.name.symbol, std::move(value));
  }
  for (const Symbol name : specials) set_special(name, *into->own(name), specials_from);
}

void Evaluator::assert_true(const std::vector<ast::Argument>& arguments, const ast::Span& where,
                            const ScopePtr& scope) {
  const ast::Expr *condition = nullptr, *message = nullptr;
  size_t position = 0;
  for (const ast::Argument& argument : arguments) {
    const bool is_named = argument.name.symbol != nullptr;
    if (is_named ? argument.name.text() == "condition" : position == 0) condition = argument.value.get();
    if (is_named ? argument.name.text() == "message" : position == 1) message = argument.value.get();
    if (!is_named && position == 2) warn("Too many unnamed arguments supplied", where);
    position += is_named ? 0 : 1;
  }
  if (!condition) warn("Ignoring unknown variable 'condition'", where);
  if (condition && truth(eval(*condition, scope))) return;
  std::string text = condition ? "Assertion '" + expression_text(*condition) + "' failed" : "Assertion failed";
  const Value note = message ? eval(*message, scope) : Value();
  if (!note.is_undef()) text += ": " + value_text(note, true, meter_);
  stop(std::move(text), where, Code::assertion);
}

void Evaluator::echo(const std::vector<ast::Argument>& arguments, const ScopePtr& scope) {
  std::string text;
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (i > 0) text += ", ";
    if (arguments[i].name.symbol) text += arguments[i].name.text() + " = ";
    append_value(text, eval(*arguments[i].value, scope), true, meter_);
  }
  meter_.claim_text(text.size());
  messages_.add({Message::Kind::echo, std::move(text), "", 0});
}

}  // namespace ombre::lang::openscad
