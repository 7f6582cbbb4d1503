// Builtin functions of strings.
#include <cmath>

#include "base/text/utf8.h"
#include "lang/engine/builtins.h"
#include "lang/engine/common_functions.h"

namespace ombre::lang {
namespace {

Value str(const BuiltinCall& call) {
  for (size_t i = 0; i < call.size(); ++i)
    if (holds_object(call[i]))
      call.expected(i, "what is known before the job runs", "a formula calls values by their names: \"2*t + x\"");
  std::string text;
  for (const Value& argument : call.all()) append_text(text, argument, false, call.meter);
  return make_text(std::move(text), call.meter);
}

// Converts numbers, lists and ranges of code points to text.
Value chr(const BuiltinCall& call) {
  std::string text;
  for (size_t i = 0; i < call.size(); ++i) {
    if (const double* code = call[i].number()) {
      common::append_character(text, *code, call.meter);
    } else if (const List* list = call[i].list()) {
      if (!is_number_list(*list)) call.expected(i, "a list of numbers");
      for (const Value& item : list->items) common::append_character(text, *item.number(), call.meter);
    } else if (const Range* range = call[i].range()) {
      const double count = range->count();
      if (count > static_cast<double>(call.meter.limits().elements)) call.meter.too_many_elements();
      for (double at = 0; at < count; ++at) common::append_character(text, range->at(at), call.meter);
    } else {
      call.expected(i, "numbers, lists or ranges of numbers");
    }
  }
  return make_text(std::move(text), call.meter);
}

Value ord(const BuiltinCall& call) {
  const std::string& text = call.text(0);
  if (text.empty()) return {};
  return static_cast<double>(code_point(text, 0));
}

}  // namespace

std::vector<Builtin> text_builtins() {
  return {
      {"str", {}, 0, true, str},
      {"chr", {"codes"}, 1, true, chr},
      {"ord", {"text"}, 1, false, ord},
  };
}

}  // namespace ombre::lang
