// Loops over values, shared by statements and list comprehensions.
#pragma once

#include "base/text/utf8.h"
#include "lang/openscad/ranges.h"
#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {

template <class Body>
void Evaluator::for_each(const Value& values, const ast::Span& where, const Body& body) {
  if (const List* list = values.list()) {
    for (const Value& value : list->items) {
      meter_.spend();
      body(value);
    }
  } else if (const Range* range = values.range()) {
    const double count = element_count(*range);
    if (count >= most_range_elements)
      return warn("Bad range parameter in for statement: too many elements (" +
                      std::to_string(static_cast<uint64_t>(count)) + ")",
                  where);
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
  } else if (!values.is_undef()) {
    body(values);
  }
}

}  // namespace ombre::lang::openscad
