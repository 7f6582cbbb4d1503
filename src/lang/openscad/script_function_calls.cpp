// Calls in expressions, with the warnings that mistakes give.
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

// Returns the parameters of what is called although it is no function.
const std::vector<ast::Parameter>& no_parameters() {
  static const std::vector<ast::Parameter> none;
  return none;
}

}  // namespace

// Reports the calls, innermost first.
void Evaluator::trace(const EnteredCalls& entered) {
  // Clang 14 cannot read std::views::reverse. NOLINTNEXTLINE(modernize-loop-convert)
  for (auto call = entered.others().rbegin(); call != entered.others().rend(); ++call)
    trace(callee_name(**call), (*call)->span);
  if (entered.first()) trace(callee_name(*entered.first()), entered.first()->span);
}

void Evaluator::stop_if_recursive(const EnteredCalls& entered) {
  constexpr int many_repeats = 8, deep = 200;
  if (!entered.last() || (entered.repeats() < many_repeats && depth_ < deep)) return;
  say_recursion(*entered.last());
  trace(entered);
  throw Stopped{};
}

void Evaluator::say_recursion(const ast::Call& call) {
  say(Message::Kind::error, "Recursion detected calling function '" + callee_name(call) + '\'', call.span);
}

void Evaluator::check_depth(const ast::Call& call, const EnteredCalls& entered) {
  constexpr size_t most_tail_calls = 1'000'000;  // as in OpenSCAD
  if (depth_ <= options_.limits.depth - spare_levels && entered.count() <= most_tail_calls) return;
  say_recursion(call);
  throw Stopped{};
}

// Sets the special variables of a used file.
void Evaluator::enter(const Unit& used, size_t specials_from) {
  for (const auto& [name, value] : unit_specials_[&used]) set_special(name, value, specials_from);
}

void Evaluator::replace_callee(const ast::Call& call, const Value& value, const ScopePtr& scope, Callee& callee) {
  warn(std::string("Can't call function on ") + type_name(value), call.span, ShownFrom::unit);
  static const ast::Undef nothing(ast::Span{});
  callee = {&no_parameters(), &nothing, scope};
}

Value Evaluator::call_other(const ast::Call& call, const ScopePtr& scope) {
  const ast::Name& name = static_cast<const ast::Variable&>(*call.callee).name;
  if (name.is_special()) {
    warn("Can't call function on dynamically scoped variable", call.span);
    return {};
  }
  const auto found = functions_.find(name.symbol);
  if (found == functions_.end() && gives_value(name, *scope)) return value_of_word(call, scope);
  if (found == functions_.end()) {
    warn("Ignoring unknown function '" + name.text() + '\'', call.span);
    return {};
  }
  if (const auto is_undefined = tests_variable(name.text(), call, *scope)) return *is_undefined;
  // OpenSCAD does not evaluate the arguments of a call with too few or too many.
  const size_t count = call.arguments.size();
  const bool is_count_right = count >= found->second.least && count <= found->second.most;
  std::vector<Value> arguments;
  arguments.reserve(count);
  bool goes_on = is_count_right;
  for (size_t n = 0; is_count_right && n < count; ++n) {
    arguments.push_back(goes_on ? eval(*call.arguments[n].value, scope) : Value());
    goes_on = !found->second.wants_numbers || (goes_on && (arguments.back().number() || arguments.back().object()));
  }
  at_ = call.span;
  if (auto made = result_of_objects(found->second.name, arguments)) return *made;
  Problems problems;
  const FunctionCall made{
      found->second.name, std::move(arguments), meter_, problems, module_calls_, random_, call, files_};
  Value result = is_count_right ? found->second.call(made) : made.wrong_count();
  warn_all(problems, call.span);
  return result;
}

void Evaluator::report_too_many(const ast::Argument&, const ast::Span& where,
                                const std::vector<ast::Parameter>& parameters) {
  if (&parameters != &no_parameters()) warn("Too many unnamed arguments supplied", where, ShownFrom::unit);
}

void Evaluator::report_parameter(const ast::Name& name, const ast::Span& where, const std::vector<ast::Parameter>&) {
  warn("variable " + name.text() + " not specified as parameter", where, ShownFrom::unit);
}

void Evaluator::report_twice(const ast::Argument&, Symbol parameter, const ast::Span& where) {
  warn("argument " + *parameter + " supplied more than once", where, ShownFrom::unit);
}

// True for a variable of let that repeats a name, or has none.
bool Evaluator::ignores(const std::vector<ast::Argument>& arguments, size_t n, const Value& value) {
  const ast::Name& name = arguments[n].name;
  if (!name.symbol) {
    warn("Assignment without variable name " + value_text(value, true, meter_), arguments[n].value->span,
         ShownFrom::unit);
    return true;
  }
  const auto is_it = [&](const ast::Argument& before) { return before.name.symbol == name.symbol; };
  if (std::none_of(arguments.begin(), arguments.begin() + static_cast<std::ptrdiff_t>(n), is_it)) return false;
  warn("Ignoring duplicate variable assignment " + name.text() + " = " + value_text(value, true, meter_),
       arguments[n].value->span, ShownFrom::unit);
  return true;
}

void Evaluator::assert_true(const std::vector<ast::Argument>& arguments, const ast::Span& where,
                            const ScopePtr& scope) {
  const ast::Expr *condition = nullptr, *message = nullptr;
  size_t position = 0;
  for (const ast::Argument& argument : arguments) {
    const bool is_named = argument.name.symbol != nullptr;
    if (is_named ? argument.name.text() == "condition" : position == 0) condition = argument.value.get();
    if (is_named ? argument.name.text() == "message" : position == 1) message = argument.value.get();
    if (!is_named && position == 2) warn("Too many unnamed arguments supplied", where, ShownFrom::unit);
    position += is_named ? 0 : 1;
  }
  if (!condition) warn("Ignoring unknown variable 'condition'", where);
  if (condition && is_true(eval(*condition, scope))) return;
  std::string text = condition ? "Assertion '" + expression_text(*condition) + "' failed" : "Assertion failed";
  const Value note = message ? eval(*message, scope) : Value();
  if (!note.is_undef()) text += ": " + value_text(note, true, meter_);
  stop(std::move(text), where, Code::assertion);
}

void Evaluator::append(std::string& text, const Value& value) { append_value(text, value, true, meter_); }

void Evaluator::print(std::string text) {
  meter_.claim_text(text.size());
  messages_.add({Message::Kind::echo, std::move(text), "", 0});
}

}  // namespace ombre::lang::openscad
