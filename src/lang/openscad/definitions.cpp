#include "lang/openscad/definitions.h"

#include <algorithm>
#include <cctype>

#include "base/text/text.h"
#include "lang/openscad/value_text.h"
#include "lang/syntax/lexer.h"

namespace ombre::lang::openscad {
namespace {

bool is_variable(std::string_view name) {
  if (name.starts_with('$')) name.remove_prefix(1);
  const auto is_letter = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  return !name.empty() && std::ranges::all_of(name, is_letter) &&
         !std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c); });
}

std::optional<std::string> literal_of_data(const Data& value) {
  if (value.is_null()) return "undef";
  if (const bool* truth = value.boolean()) return *truth ? "true" : "false";
  if (const double* number = value.number()) return literal_of(*number);
  if (const std::string* text = value.string()) return literal_of(*text);
  if (!value.list()) return std::nullopt;
  std::vector<std::string> elements;
  for (const Data& element : *value.list()) {
    auto own = literal_of_data(element);
    if (!own) return std::nullopt;
    elements.push_back(std::move(*own));
  }
  return '[' + join(elements, ", ") + ']';
}

}  // namespace

std::optional<std::string> definition_of(const std::string& name, const Data& value) {
  if (!is_variable(name)) return std::nullopt;
  const auto text = literal_of_data(value);
  return text ? std::optional(name + '=' + *text) : std::nullopt;
}

bool mentions(const SourcePtr& script, std::string_view name) {
  Diagnostics ignored;
  Lexer lexer(script, 0, Dialect::openscad, ignored);
  for (Token token = lexer.next(); token.kind != TokenKind::end; token = lexer.next())
    if (token.kind == TokenKind::name && script->text().substr(token.begin, token.end - token.begin) == name)
      return true;
  return false;
}

}  // namespace ombre::lang::openscad
