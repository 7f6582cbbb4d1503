// Loops over values, shared by statements and list comprehensions.
#pragma once

#include "base/text/utf8.h"
#include "lang/engine/interpreter.h"

namespace ombre::lang {

template <class Body>
void Interpreter::for_each(const Value& values, const ast::Span& where, const char* expected, const Body& body) {
  if (const List* list = values.list()) {
    for (const Value& value : list->items) {
      meter_.spend();
      body(value);
    }
  } else if (const Range* range = values.range()) {
    const double count = range->count();
    check_count(count, where, "range");
    for (double i = 0; i < count; ++i) {
      meter_.spend();
      body(Value(range->at(i)));
    }
  } else if (const Text* text = values.text()) {
    for (size_t at = 0; at < text->text.size();) {
      meter_.spend();
      const size_t size = std::max<size_t>(1, code_point_size(text->text, at));
      body(make_text(text->text.substr(at, size), meter_));
      at += size;
    }
  } else {
    fail_found(where, expected, values, "a range is written [first : last] or [first : step : last]");
  }
}

template <class Body>
void Interpreter::for_each_scope(const ast::Argument& loop, const ScopePtr& scope, const Body& body) {
  const Value values = eval(*loop.value, scope);
  const SpecialsMark mark(*this);
  ScopePtr inner = make_scope(scope);
  for_each(values, loop.value->span, "\"for\" needs a range, a list or a string", [&](const Value& value) {
    // Reuses the scope for the next pass, unless a closure holds it.
    if (inner->use_count() > 1) inner = make_scope(scope);
    inner->clear();
    set_variable(loop.name, value, *inner, mark.size());
    body(inner);
  });
}

}  // namespace ombre::lang
