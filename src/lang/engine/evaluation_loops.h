// Loops over values, in statements and list comprehensions.
#pragma once

#include "base/text/utf8.h"
#include "lang/engine/evaluation.h"

namespace ombre::lang {

template <class Language, class Product>
template <class Body>
void Evaluation<Language, Product>::for_each(const Value& values, const ast::Span& where, const char* expected,
                                             const Body& body) {
  if (const List* list = values.list()) {
    for (const Value& value : list->items) {
      meter_.spend();
      body(value);
    }
  } else if (const Range* range = values.range()) {
    const double count = self().passes(*range, where);
    for (double i = 0; i < count; ++i) {
      meter_.spend();
      body(Value(range->at(i)));
    }
  } else if (const Text* text = values.text()) {
    for (size_t at = 0; at < text->text.size();) {
      meter_.spend();
      const size_t size = character_size(text->text, at);
      body(make_text(text->text.substr(at, size), meter_));
      at += size;
    }
  } else if (const Record* record = values.record()) {
    for (const auto& [name, member] : record->members) {
      meter_.spend();
      body(make_text(name, meter_));
    }
  } else if (self().is_one_pass(values, where, expected)) {
    body(values);
  }
}

template <class Language, class Product>
template <class Body>
void Evaluation<Language, Product>::for_each_scope(const ast::Argument& loop, const ast::Span& whole,
                                                   const ScopePtr& scope, const Body& body) {
  const Value values = eval(*loop.value, scope);
  const SpecialsMark mark(*this);
  ScopePtr inner = make_scope(scope);
  const auto pass = [&](const Value& value) {
    // Reuses the scope for the next pass, unless a closure holds it.
    if (inner->use_count() > 1) inner = make_scope(scope);
    inner->clear();
    if (loop.name.symbol) set_variable(loop.name, value, *inner, mark.size());
    body(inner);
  };
  for_each(values, place(whole, loop.value->span), "\"for\" needs a range, a list or a string", pass);
}

template <class Language, class Product>
void Evaluation<Language, Product>::generate(const ast::Expr& expr, const ScopePtr& scope, ListBuilder& out) {
  using Kind = ast::Expr::Kind;
  const auto level = deeper(expr.span);
  switch (expr.kind) {
    case Kind::generate_for:
      return generate_for(static_cast<const ast::GenerateFor&>(expr), 0, scope, out);
    case Kind::generate_loop:
      return generate_loop(static_cast<const ast::GenerateLoop&>(expr), scope, out);
    case Kind::generate_each:
      return generate_each(static_cast<const ast::GenerateEach&>(expr), scope, out);
    case Kind::generate_if: {
      const auto& choice = static_cast<const ast::GenerateIf&>(expr);
      if (holds(*choice.condition, scope)) return generate(*choice.element, scope, out);
      if (choice.otherwise) generate(*choice.otherwise, scope, out);
      return;
    }
    case Kind::prefix: {
      ScopePtr inner = scope;
      const SpecialsMark mark(*this);
      const ast::Expr* element = enter_prefix(static_cast<const ast::Prefix&>(expr), inner, mark.size());
      return element ? generate(*element, inner, out) : out.push(Value());
    }
    default:
      return out.push(eval(expr, scope));
  }
}

template <class Language, class Product>
void Evaluation<Language, Product>::generate_for(const ast::GenerateFor& loop, size_t variable, const ScopePtr& scope,
                                                 ListBuilder& out) {
  if (variable == loop.loops.size()) return generate(*loop.element, scope, out);
  const auto level = deeper(loop.span);
  for_each_scope(loop.loops[variable], loop.span, scope,
                 [&](const ScopePtr& inner) { generate_for(loop, variable + 1, inner, out); });
}

// Each pass has its own scope. The values of "next" are computed from the previous pass.
template <class Language, class Product>
void Evaluation<Language, Product>::generate_loop(const ast::GenerateLoop& loop, const ScopePtr& scope,
                                                  ListBuilder& out) {
  const SpecialsMark mark(*this);
  ScopePtr pass = make_scope(scope);
  bind_let(loop.init, pass, mark.size());
  for (uint64_t count = 0; holds(*loop.condition, pass); ++count) {
    self().check_pass(count, loop);
    meter_.spend();
    generate(*loop.element, pass, out);
    ScopePtr next = make_scope(scope);
    for (const auto& [name, value] : pass->variables()) next->set(name, value);
    bind_let(loop.next, next, mark.size());
    pass = std::move(next);
  }
}

template <class Language, class Product>
void Evaluation<Language, Product>::generate_each(const ast::GenerateEach& each, const ScopePtr& scope,
                                                  ListBuilder& out) {
  ListBuilder inner(meter_);
  generate(*each.element, scope, inner);
  const Value values = inner.finish();
  for (const Value& value : values.list()->items)
    for_each(value, place(each.span, each.element->span), "\"each\" needs a range, a list or a string",
             [&](const Value& element) { out.push(element); });
}

}  // namespace ombre::lang
