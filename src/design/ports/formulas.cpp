// Reads numbers that are formulas, with the values and attributes that they refer to by name.
#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "design/attributes.h"
#include "design/outputs.h"
#include "design/ports/numbers.h"

namespace ombre::design {
namespace {

// Reads plain numbers, which most expressions are, without the parser.
std::optional<double> plain_number(const std::string& text) {
  const bool begins_one = !text.empty() && (text[0] == '-' || text[0] == '.' || (text[0] >= '0' && text[0] <= '9'));
  return begins_one ? parse_number(text) : std::nullopt;
}

void warn_of_two_meanings(const std::string& name, const SourceRange& where, const Reader& reader) {
  reader.diagnostics.add_new(
      {Severity::warning, where,
       "\"" + name + "\" is the formula's own variable here, not the script's variable of that name",
       "give the script's variable another name if you mean that one"});
}

// Adds those variables to the known ones that are attributes of the inputs. Returns false and adds a diagnostic if the
// script has a number or value of that name, too.
bool add_attributes(const expr::Expression& expression, const Data& data, const Domain& domain, const Reader& reader,
                    std::vector<std::string>& known) {
  if (!domain.child_attributes || !reader.inputs) return true;
  bool good = true;
  std::vector<std::string> found;
  expression.with_substitutes([&](const expr::Node& variable) -> std::optional<expr::Expression> {
    const auto is_listed = [&](const auto& names) { return std::ranges::find(names, variable.name) != names.end(); };
    if (is_listed(known) || is_listed(found) || !gives_attribute(*reader.inputs, variable.name)) return std::nullopt;
    found.push_back(variable.name);
    const std::string spelling = data.string()->substr(variable.begin, variable.end - variable.begin);
    const auto value = reader.names ? (*reader.names)(spelling) : std::nullopt;
    if (!value || !(value->number() || is_value(*value))) return std::nullopt;
    reader.diagnostics.error(expr::Expression::place(variable, *data.string(), data.where),
                             '"' + spelling +
                                 "\" is an attribute of what is inside the braces, and the script has a "
                                 "variable of that name too",
                             "give the variable another name");
    good = false;
    return std::nullopt;
  });
  known.insert(known.end(), found.begin(), found.end());
  return good;
}

// Replaces variables that formulas do not define by numbers and values of the script.
std::optional<expr::Expression> with_named_values(const expr::Expression& expression, const Data& data,
                                                  const std::vector<std::string>& known, const Domain& domain,
                                                  const Reader& reader) {
  const std::string& text = *data.string();
  bool good = true;
  auto result = expression.with_substitutes([&](const expr::Node& variable) -> std::optional<expr::Expression> {
    const std::string spelling = text.substr(variable.begin, variable.end - variable.begin);
    const auto value = (*reader.names)(spelling);
    if (!value || !(value->number() || is_value(*value))) return std::nullopt;
    if (std::ranges::find(known, variable.name) != known.end()) {
      warn_of_two_meanings(spelling, expr::Expression::place(variable, text, data.where), reader);
      return std::nullopt;
    }
    if (const double* number = value->number()) return expr::Expression::constant(*number);
    auto formula = read_formula(*value, domain, reader);
    good = good && formula;
    return formula;
  });
  return good ? std::optional(std::move(result)) : std::nullopt;
}

// Reads the expression of a text, including the values that it refers to by name.
std::optional<expr::Expression> read_expression(const Data& data, const Domain& domain, const Reader& reader) {
  const std::string& text = *data.string();
  auto expression = expr::Expression::parse(text, data.where, reader.diagnostics);
  if (!expression) return std::nullopt;
  std::vector<std::string> known = known_variables(domain);
  if (!add_attributes(*expression, data, domain, reader, known)) return std::nullopt;
  if (reader.names) {
    const auto named = with_named_values(*expression, data, known, domain, reader);
    if (!named) return std::nullopt;
    expression = *named;
  }
  if (!expression->check_variables(known, text, data.where, reader.diagnostics)) return std::nullopt;
  return expression;
}

bool set_expression(expr::Expression expression, const Data& data, const Domain& domain, Number& value,
                    const Reader& reader) {
  const auto constant = expression.constant_value();
  // An infinite constant stays an expression, and the job counts the voxels where it matters.
  if (!constant || (!std::isfinite(*constant) && !std::isfinite(domain.least))) {
    for (const NodePtr& node : nodes_of(expression)) reader.keep(node);
    value = std::move(expression);
    return true;
  }
  double number = 0;
  if (!design::read(Data(*constant, data.where), domain, number, reader)) return false;
  value = number;
  return true;
}

}  // namespace

bool Port<Number>::read(const Data& data, const Domain& domain, Number& value, const Reader& reader) {
  double number = 0;
  if (const std::string* text = data.string()) {
    if (const auto plain = plain_number(*text)) {
      if (!design::read(Data(*plain, data.where), domain, number, reader)) return false;
      value = number;
      return true;
    }
    auto expression = read_expression(data, domain, reader);
    return expression && set_expression(std::move(*expression), data, domain, value, reader);
  }
  if (is_value(data)) {
    auto expression = read_formula(data, domain, reader);
    return expression && set_expression(std::move(*expression), data, domain, value, reader);
  }
  if (const auto source = std::dynamic_pointer_cast<const program::FieldSource>(data.host_object())) {
    value = expr::Expression::of_source(source);
    return true;
  }
  if (!data.number()) return reader.fail(data, "a number" + unit_text(domain) + " or an expression in quotes");
  if (!design::read(data, domain, number, reader)) return false;
  value = number;
  return true;
}

}  // namespace ombre::design
