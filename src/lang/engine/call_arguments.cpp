// Conversion of values to arguments of nodes: plain data with source positions.
#include "lang/engine/interpreter.h"

namespace ombre::lang {

namespace {

// Returns the position of a literal string, even if the value was passed on through variables; else `otherwise`.
SourceRange place_of(const Text& text, const SourceRange& otherwise) {
  return text.origin && text.origin->is_plain ? text.origin->inside().range() : otherwise;
}

}  // namespace

Data Interpreter::to_data(const Value& value, const SourceRange& where, const ast::Span& argument) {
  meter_.spend();
  if (const double* number = value.number()) return {*number, where};
  if (const Text* text = value.text()) {
    argument_bytes_ += text->text.size();
    meter_.check_text(argument_bytes_);
    return {text->text, place_of(*text, where)};
  }
  if (const List* list = value.list()) return list_to_data(*list, where, argument);
  if (const bool* boolean = value.boolean()) return {*boolean, where};
  if (const Range* range = value.range()) return range_to_data(*range, where, argument);
  if (value.closure()) fail(argument, "a function cannot be a parameter of a node", "call it, and give its result");
  if (const Object* object = value.object()) {
    Data data = object->data();
    data.where = where;
    return data;
  }
  Data nothing;
  nothing.where = where;
  return nothing;
}

Data Interpreter::list_to_data(const List& list, const SourceRange& where, const ast::Span& argument) {
  DataList items;
  items.reserve(list.items.size());
  for (size_t i = 0; i < list.items.size(); ++i) {
    const ast::Expr* written = list.origin ? list.origin->elements[i].get() : nullptr;
    if (written)
      items.push_back(to_data(list.items[i], written->span.range(), argument));
    else
      items.push_back(to_data(list.items[i], where, argument));
  }
  return {std::move(items), where};
}

Data Interpreter::range_to_data(const Range& range, const SourceRange& where, const ast::Span& argument) {
  const double count = range.count();
  check_count(count, argument, "range");
  meter_.spend(static_cast<uint64_t>(count));
  DataList items;
  items.reserve(static_cast<size_t>(count));
  for (double i = 0; i < count; ++i) items.emplace_back(range.at(i), where);
  return {std::move(items), where};
}

}  // namespace ombre::lang
