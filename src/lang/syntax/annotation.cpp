#include "lang/syntax/annotation.h"

#include "base/text/text.h"

namespace ombre::lang {

using ast::Expr;

namespace {

std::vector<std::string> parts_of(std::string_view text, char at) {
  std::vector<std::string> parts;
  bool is_quoted = false;
  std::string part;
  for (const char c : text) {
    if (c == '"') is_quoted = !is_quoted;
    if (c == at && !is_quoted)
      parts.push_back(std::string(trim(std::exchange(part, {}))));
    else
      part += c;
  }
  parts.push_back(std::string(trim(part)));
  return parts;
}

Data choice_value(const std::string& text, bool is_text) {
  const bool is_quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  if (is_quoted) return Data(text.substr(1, text.size() - 2));
  if (const auto number = parse_number(text); number && !is_text) return Data(*number);
  return Data(text);
}

}  // namespace

std::optional<Data> plain_value(const Expr& expr) {
  if (expr.kind == Expr::Kind::number) return Data(static_cast<const ast::Number&>(expr).value);
  if (expr.kind == Expr::Kind::boolean) return Data(static_cast<const ast::Boolean&>(expr).value);
  if (expr.kind == Expr::Kind::string) return Data(static_cast<const ast::String&>(expr).value);
  if (expr.kind == Expr::Kind::unary) {
    const auto& sign = static_cast<const ast::Unary&>(expr);
    const auto number = plain_value(*sign.operand);
    if (sign.op == ast::Operator::negate && number && number->number()) return Data(-*number->number());
    return std::nullopt;
  }
  if (expr.kind != Expr::Kind::list) return std::nullopt;
  DataList items;
  for (const ast::ExprPtr& element : static_cast<const ast::List&>(expr).elements) {
    auto item = plain_value(*element);
    if (!item || !item->number()) return std::nullopt;
    items.push_back(std::move(*item));
  }
  return items.empty() ? std::nullopt : std::optional(Data(std::move(items)));
}

bool read_range(std::string_view inside, Allowed& allowed) {
  std::vector<double> numbers;
  for (const std::string& part : parts_of(inside, ':')) {
    const auto number = parse_number(part);
    if (!number) return false;
    numbers.push_back(*number);
  }
  if (numbers.size() > 3) return false;
  allowed.most = numbers.back();
  if (numbers.size() > 1) allowed.least = numbers.front();
  if (numbers.size() == 3) allowed.step = numbers[1];
  return true;
}

void read_choices(std::string_view inside, bool is_text, Allowed& allowed) {
  for (const std::string& item : parts_of(inside, ',')) {
    const std::vector<std::string> parts = parts_of(item, ':');
    Data value = choice_value(parts[0], is_text);
    const Data label = choice_value(parts.back(), true);
    allowed.choices.emplace_back(std::move(value), *label.string());
  }
}

}  // namespace ombre::lang
