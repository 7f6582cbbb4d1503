// Diagnostics of the interpreter. Each is reported once.
#include <algorithm>
#include <functional>

#include "lang/engine/interpreter.h"

namespace ombre::lang {
namespace {

constexpr size_t most_reported = 1000;  // different ones; in a larger design they have a common cause

std::string text_at(const ast::Span& span) {
  return std::string((*span.source)->text().substr(span.begin, span.end - span.begin));
}

std::vector<std::string> names_of(const std::vector<ast::Parameter>& parameters) {
  std::vector<std::string> names;
  names.reserve(parameters.size());
  for (const ast::Parameter& parameter : parameters) names.push_back(parameter.name.text());
  return names;
}

std::string listed(const std::vector<ast::Parameter>& parameters) {
  return parameters.empty() ? "it takes none" : "it takes " + join(names_of(parameters), ", ");
}

void add_names(std::vector<std::string>& names, const Scope& scope) {
  for (const auto& [symbol, value] : scope.variables()) names.push_back(*symbol);
}

}  // namespace

void Interpreter::report(Diagnostic diagnostic) {
  std::string key = diagnostic.where.source ? diagnostic.where.source->name() : "";
  key += ':' + std::to_string(diagnostic.where.begin) + ':' + diagnostic.message;
  if (reported_.size() < most_reported && reported_.insert(std::move(key)).second)
    diagnostics_.add(std::move(diagnostic));
}

void Interpreter::fail(const ast::Span& where, std::string_view message, const Phrase& hint) {
  fail(Code::script, where, message, hint);
}

void Interpreter::fail(Code code, const ast::Span& where, std::string_view message, const Phrase& hint,
                       CodeValues values) {
  report({Severity::error, where.range(), std::string(message), hint, code, std::move(values)});
  throw Stopped{};
}

void Interpreter::fail_found(const ast::Span& where, std::string_view expected, const Value& found,
                             const Phrase& hint) {
  fail(where, std::string(expected) + ", found " + describe(found), hint.empty() ? Phrase(hint_for(found)) : hint);
}

void Interpreter::fail_operator(ast::Operator op, const ast::Span& where, const Value& left, const Value& right,
                                const Mismatch& mismatch) {
  if (mismatch.right.empty())
    fail(where, '"' + std::string(spelling(op)) + "\" needs a number or a list of numbers, found " + mismatch.left);
  const bool is_text = op == ast::Operator::add && (left.text() || right.text());
  const bool is_outermost = mismatch.left == describe(left) && mismatch.right == describe(right);
  fail(where,
       "cannot compute " + mismatch.left + ' ' + spelling(op) + ' ' + mismatch.right +
           (is_outermost ? "" : ", inside of lists"),
       is_text ? "write str(a, b) to join texts" : "");
}

void Interpreter::stop_at_depth(const ast::Span&) {
  throw LimitReached{"calls and operators are evaluated inside each other deeper than " +
                         format_count(static_cast<unsigned>(options_.limits.depth)) + " levels",
                     "end the recursion, or let the function end with its own call, which takes no depth"};
}

void Interpreter::stop_without_part(const ast::Member& member, const Object& object, const std::string& known) {
  fail(member.member.span, object.describe() + " has no \"." + member.member.text() + '"', known);
}

void Interpreter::stop_at_function(const ast::Span& argument) {
  fail(argument, "a function cannot be a parameter of a node", "call it, and give its result");
}

void Interpreter::stop_at_choice(const ast::Span& where, const Value& yes, const Value& no) {
  fail(where, "this condition varies in space, and cannot choose between " + describe(yes) + " and " + describe(no),
       "give numbers on both sides of the colon, or materials, or lists of them");
}

void Interpreter::report_parameter(const ast::Name& name, const ast::Span& callee,
                                   const std::vector<ast::Parameter>& parameters) {
  const std::string suggestion = did_you_mean(name.text(), names_of(parameters));
  fail(name.span, '"' + text_at(callee) + "\" has no parameter \"" + name.text() + '"',
       suggestion.empty() ? listed(parameters) : suggestion);
}

void Interpreter::report_too_many(const ast::Argument& argument, const ast::Span& callee,
                                  const std::vector<ast::Parameter>& parameters) {
  fail(argument.value->span, "too many arguments for \"" + text_at(callee) + '"', listed(parameters));
}

void Interpreter::report_twice(const ast::Argument& argument, Symbol parameter, const ast::Span&) {
  const ast::Span& where = argument.name.symbol ? argument.name.span : argument.value->span;
  fail(where, "the parameter \"" + *parameter + "\" is given twice");
}

void Interpreter::fail_builtin(const ast::Span& where, const Builtin& builtin, std::string_view problem,
                               std::string_view rest) {
  fail(where, std::string(problem).append(builtin.name).append(rest), "write " + builtin.signature());
}

void Interpreter::fail_assertion(const ast::Span& condition) {
  const std::string text = text_at(condition);
  const bool is_short = text.size() <= 60 && text.find('\n') == std::string::npos;
  fail(Code::assertion, condition,
       is_short ? "the assertion \"" + text + "\" does not hold" : "the assertion does not hold");
}

void Interpreter::fail_unknown(Code code, const ast::Name& name, const char* what, std::vector<std::string> candidates,
                               const std::string& otherwise) {
  std::sort(candidates.begin(), candidates.end());
  // Suggests nothing for single letters, since all of them are similar.
  const std::string suggestion = name.text().size() > 1 ? did_you_mean(name.text(), candidates) : "";
  fail(code, name.span, "there is no " + std::string(what) + " \"" + name.text() + '"',
       suggestion.empty() ? otherwise : suggestion,
       {{code == Code::unknown_node ? "node" : "name", name.text()},
        {"similar", suggestion.empty() ? "" : closest_name(name.text(), candidates).value_or("")}});
}

namespace {

// Calls of(plan) for the definitions of each scope, and for those of the files that it uses.
void for_each_plan(const Scope& scope, const std::function<void(const ast::Plan&)>& of) {
  for (const Scope* at = &scope; at; at = at->parent().get()) {
    if (at->plan()) of(*at->plan());
    if (!at->unit()) continue;
    for (const Unit* used : at->unit()->uses) of(used->plan);
  }
}

}  // namespace

// Returns what to write if a library has an operator of this name.
std::string Interpreter::hint_of_libraries(const ast::Name& name) const {
  const std::string file = options_.library_of ? options_.library_of(name.text()) : "";
  return file.empty() ? "" : "a library has it; write at the top: use <" + file + '>';
}

std::string Interpreter::mismatch_of_material(const std::string& name) const {
  if (const auto known = vocabulary_.constant(name); known && known->string()) return "";
  const std::string similar = did_you_mean(name, vocabulary_.constants());
  return "there is no material \"" + name + '"' + (similar.empty() ? "" : "; " + similar);
}

Value Interpreter::value_of_unknown(const ast::Name& name, const Scope& scope) {
  std::vector<std::string> candidates = vocabulary_.constants();
  for (const auto& [symbol, value] : specials_) candidates.push_back(*symbol);
  candidates.emplace_back("PI");
  for (const Scope* at = &scope; at; at = at->parent().get()) {
    if (at->plan() && at->plan()->assigns(name.symbol))
      fail(name.span, '"' + name.text() + "\" has no value yet",
           "its assignment comes later in this scope; move it up");
    if (at->plan() && at->plan()->function(name.symbol))
      fail(name.span, '"' + name.text() + "\" is a function, not a value", "call it: " + name.text() + "(...)");
    add_names(candidates, *at);
  }
  std::string otherwise = "give it a value first: " + name.text() + " = ...;";
  if (builtins_.count(name.symbol)) otherwise = "it is a function; call it: " + name.text() + "(...)";
  fail_unknown(Code::unknown_variable, name, "variable", std::move(candidates), otherwise);
}

void Interpreter::fail_unknown_function(const ast::Name& name, const Scope& scope) {
  if (const Value* value = scope.find(name.symbol))
    fail(name.span, '"' + name.text() + "\" is " + describe(*value) + ", not a function");
  std::vector<std::string> candidates;
  for (const auto& [symbol, builtin] : builtins_) candidates.push_back(*symbol);
  for (const std::string& value : vocabulary_.value_names()) candidates.push_back(value);
  bool is_module = knows(name);
  for_each_plan(scope, [&](const ast::Plan& plan) {
    for (const ast::FunctionDef* function : plan.functions) candidates.push_back(function->name.text());
    is_module = is_module || plan.module(name.symbol);
  });
  if (const std::string hint = hint_of_libraries(name); !hint.empty())
    fail(Code::unknown_function, name.span, "there is no function \"" + name.text() + '"', hint,
         {{"name", name.text()}});
  const std::string otherwise = is_module ? '"' + name.text() + "\" is a node, and stands in statements only"
                                          : "define it first: function " + name.text() + "(...) = ...;";
  fail_unknown(Code::unknown_function, name, "function", std::move(candidates), otherwise);
}

void Interpreter::fail_unknown_module(const ast::Name& name, const Scope& scope) {
  if (const std::string hint = vocabulary_.hint(name.text()); !hint.empty())
    fail(Code::unknown_node, name.span, "there is no node or module \"" + name.text() + '"', hint,
         {{"node", name.text()}});
  std::vector<std::string> candidates = vocabulary_.names();
  candidates.emplace_back("children");
  bool is_function = false;
  for_each_plan(scope, [&](const ast::Plan& plan) {
    for (const ast::ModuleDef* module : plan.modules) candidates.push_back(module->name.text());
    is_function = is_function || plan.function(name.symbol);
  });
  const auto stop = [&](const std::string& hint) {
    fail(Code::unknown_node, name.span, "there is no node or module \"" + name.text() + '"', hint,
         {{"node", name.text()}});
  };
  if (is_function) stop("it is a function, whose value stands in an expression or after =");
  if (const std::string hint = hint_of_libraries(name); !hint.empty()) stop(hint);
  fail_unknown(Code::unknown_node, name, "node or module", std::move(candidates),
               "define it first: module " + name.text() + "(...) { ... }");
}

}  // namespace ombre::lang
