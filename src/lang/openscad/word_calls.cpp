// Words of `use <ombre>`: their calls as statements and in expressions, and values that vary in space.
#include <algorithm>

#include "lang/engine/evaluation_calls.h"
#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {

namespace {

std::string word_of(const ast::Name& name) {
  const std::string& text = name.text();
  return text.starts_with(word_prefix) ? text.substr(word_prefix.size()) : text;
}

}  // namespace

void Evaluator::check_words() {
  if (options_.words || std::ranges::none_of(program_.units, &Unit::has_words)) return;
  stop("words of Ombre cannot be used here; give the script that says use <ombre> as the design itself", {});
}

bool Evaluator::has_words(const Scope& scope) const {
  if (!options_.words) return false;
  const Scope* at = &scope;
  while (!at->unit() && at->parent()) at = at->parent().get();
  return at->unit() && at->unit()->has_words;
}

bool Evaluator::makes_solid(const ast::Name& name, const Scope& scope) const {
  return has_words(scope) && options_.words->makes_solid(word_of(name));
}

bool Evaluator::gives_value(const ast::Name& name, const Scope& scope) const {
  return has_words(scope) && options_.words->gives_value(word_of(name));
}

// Converts arguments for the vocabulary. `written` is set to their text in .csg files.
Invocation Evaluator::word_call(const ast::Name& name, const ast::Span& whole,
                                const std::vector<ast::Argument>& arguments, const ScopePtr& scope,
                                std::string& written) {
  Invocation call;
  call.name = word_of(name);
  call.where = name.span.range();
  call.whole = whole.range();
  node_arguments(arguments, scope, call, [&](const ast::Argument& argument, const Value& value) {
    const std::string label = argument.name.symbol ? argument.name.text() + " = " : "";
    written += (written.empty() ? "" : ", ") + label + value_text(value, true, meter_);
  });
  call.facets = special_number(facets_name_);
  return call;
}

solids::TreePtr Evaluator::run_word(const ast::CallStatement& statement, const ScopePtr& scope) {
  const SpecialsMark mark(*this);
  solids::Word word{statement.name.text(), "", nullptr};
  Invocation call = word_call(statement.name, statement.whole, statement.arguments, scope, word.arguments);
  auto result = tree(solids::Group{}, statement.span);
  run_block(statement.children, scope, result->children);
  call.braces = braces_of(statement);
  at_ = statement.span;
  Diagnostics found;
  word.solid = options_.words->make(std::move(call), result->children, found);
  report_words(found, statement.span);
  if (!word.solid) return nullptr;
  result->operation = std::move(word);
  return result;
}

Value Evaluator::value_of_word(const ast::Call& call, const ScopePtr& scope) {
  const SpecialsMark mark(*this);
  std::string written;
  const ast::Name& name = static_cast<const ast::Variable&>(*call.callee).name;
  Invocation invocation = word_call(name, call.span, call.arguments, scope, written);
  at_ = call.span;
  meter_.count_instance();
  Diagnostics found;
  auto value = options_.words->value(std::move(invocation), found, meter_);
  report_words(found, call.span);
  return value ? std::move(*value) : Value();
}

// Adds messages. An error stops the evaluation.
void Evaluator::report_words(const Diagnostics& found, const ast::Span& where) {
  const auto place_of = [&](const Diagnostic& diagnostic) {
    const bool is_here = where.source && diagnostic.where.source == *where.source;
    return is_here ? ast::Span{where.source, diagnostic.where.begin, diagnostic.where.end} : where;
  };
  for (const Diagnostic& diagnostic : found.list()) {
    const std::string text = sentence_of(diagnostic);
    if (diagnostic.severity == Severity::warning) warn(text, place_of(diagnostic));
    if (diagnostic.severity == Severity::note) say(Message::Kind::note, text, place_of(diagnostic));
  }
  for (const Diagnostic& diagnostic : found.list())
    if (diagnostic.severity == Severity::error) messages_.details.add(diagnostic);
  for (const Diagnostic& diagnostic : found.list())
    if (diagnostic.severity == Severity::error) stop(diagnostic.message, place_of(diagnostic));
}

void Evaluator::stop_at_function(const ast::Span& argument) {
  stop("a function cannot be an argument of a word; call it, and give its result", argument);
}

}  // namespace ombre::lang::openscad
