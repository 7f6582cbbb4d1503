#include "lang/engine/builtins.h"

#include "lang/engine/common_functions.h"

namespace ombre::lang {

double BuiltinCall::number(size_t i) const {
  const double* value = arguments_[i].number();
  if (!value) expected(i, "a number");
  return *value;
}

const List& BuiltinCall::list(size_t i) const {
  const List* value = arguments_[i].list();
  if (!value) expected(i, "a list");
  return *value;
}

const std::string& BuiltinCall::text(size_t i) const {
  const Text* value = arguments_[i].text();
  if (!value) expected(i, "a string");
  return value->text;
}

Value BuiltinCall::expected(size_t i, const std::string& what, const Phrase& hint) const {
  throw BadArgument{i, std::string(name_) + "() needs " + what + ", found " + describe(arguments_[i]),
                    hint.empty() ? Phrase(hint_for(arguments_[i])) : hint};
}

std::string Builtin::signature() const {
  std::string text = std::string(name) + '(';
  for (size_t i = 0; i < parameters.size(); ++i) {
    text += i > 0 ? ", " : "";
    text += i < required ? parameters[i] : '[' + std::string(parameters[i]) + ']';
  }
  if (is_variadic) text += parameters.empty() ? "..." : ", ...";
  return text + ')';
}

const std::vector<Builtin>& builtins() {
  static const std::vector<Builtin> all = [] {
    std::vector<Builtin> table;
    for (const auto& [name, parameters, is_variadic, call] : common_functions<BuiltinCall>())
      table.push_back({name, parameters, parameters.size(), is_variadic, call, false});
    for (const auto& part : {math_builtins(), list_builtins(), text_builtins(), point_builtins()})
      table.insert(table.end(), part.begin(), part.end());
    return table;
  }();
  return all;
}

}  // namespace ombre::lang
