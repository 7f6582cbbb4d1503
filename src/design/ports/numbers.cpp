#include "design/ports/numbers.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"
#include "design/attributes.h"
#include "design/outputs.h"
#include "design/ports/places.h"
#include "program/evaluate.h"

namespace ombre::design {

program::Field Number::at(const program::Point& p, const expr::Variables& extra) const {
  if (const double* value = constant()) return p.constant(*value);
  return expression()->lower(p, extra);
}

bool Number::uses_cell() const {
  return expression() && std::ranges::any_of(expr::cell_names(), [&](auto name) { return expression()->uses(name); });
}

Interval Number::range(const Box& where, const std::map<std::string_view, Interval>& extra) const {
  if (const double* value = constant()) return *value;
  program::Builder builder;
  const OutputsAlone outputs(builder, true);
  program::Point p = program::Point::origin_frame(builder);
  if (uses_cell() || !expression()->inputs().empty()) p.cell = {anything(p), anything(p), anything(p)};
  const auto known = [&](std::string_view name) -> std::optional<program::Field> {
    const auto it = extra.find(name);
    if (it == extra.end()) return std::nullopt;
    return min(max(anything(p), it->second.lo), p.constant(it->second.hi));
  };
  const program::Field field = expression()->lower(p, known);
  const program::Program program = builder.finish({{"value", field}});
  std::vector<Interval> values;
  program::evaluate_intervals(program, where, values);
  return values[program.outputs[0]];
}

std::vector<std::string> known_variables(const Domain& domain) {
  std::vector<std::string> known = expr::coordinate_names();
  known.insert(known.end(), domain.variables.begin(), domain.variables.end());
  return known;
}

namespace {

std::string range_text(const Domain& domain) {
  std::string text;
  if (std::isfinite(domain.least))
    text = (domain.above_least ? "greater than " : "of at least ") + format_number(domain.least);
  if (std::isfinite(domain.greatest))
    text += (text.empty() ? "of at most " : " and at most ") + format_number(domain.greatest);
  return text;
}

bool in_range(double v, const Domain& domain) {
  return std::isfinite(v) && v <= domain.greatest && (domain.above_least ? v > domain.least : v >= domain.least);
}

// Moves a number that rounding has put just beyond an end of the range to that end.
double without_noise(double v, const Domain& domain) {
  constexpr double noise = 1e-12;
  if (v < domain.least && !domain.above_least && v >= domain.least - noise * std::max(1.0, std::abs(domain.least)))
    return domain.least;
  if (v > domain.greatest && v <= domain.greatest + noise * std::max(1.0, std::abs(domain.greatest)))
    return domain.greatest;
  return v;
}

// Reads plain numbers, which most expressions are, without the parser.
std::optional<double> plain_number(const std::string& text) {
  const bool begins_one = !text.empty() && (text[0] == '-' || text[0] == '.' || (text[0] >= '0' && text[0] <= '9'));
  return begins_one ? parse_number(text) : std::nullopt;
}

}  // namespace

bool Port<double>::read(const Data& data, const Domain& domain, double& value, const Reader& reader) {
  const double* number = data.number();
  if (!number) return reader.fail(data, "a number" + unit_text(domain));
  const double near = without_noise(*number, domain);
  if (!in_range(near, domain)) {
    const std::string range = range_text(domain);
    return reader.fail(data, range.empty() ? "a finite number" : "a number " + range + unit_text(domain), {},
                       Code::parameter_range);
  }
  value = near;
  return true;
}

Data Port<double>::write(const double& value, bool) { return Data(value); }

bool Port<int>::read(const Data& data, const Domain& domain, int& value, const Reader& reader) {
  const int least = static_cast<int>(std::max(domain.least, -1e9)),
            greatest = static_cast<int>(std::min(domain.greatest, 1e9));
  const double* number = data.number();
  // Accepts rounding errors: a quotient such as 0.3 / 0.1 is nearly whole.
  constexpr double noise = 1e-9;
  const double whole = number ? std::round(*number) : 0;
  if (!number || !(std::abs(*number - whole) <= noise) || whole < least || whole > greatest)
    return reader.fail(data, "a whole number from " + std::to_string(least) + " to " + std::to_string(greatest), {},
                       data.number() ? Code::parameter_range : Code::parameter_type);
  value = static_cast<int>(whole);
  return true;
}

bool Port<Counts3>::read(const Data& data, const Domain& domain, Counts3& value, const Reader& reader) {
  const DataList* list = data.list();
  if (!list || list->size() != 3) return reader.fail(data, "three whole numbers (x, y, z)");
  bool good = true;
  for (size_t axis = 0; axis < 3; ++axis) good = design::read((*list)[axis], domain, value[axis], reader) && good;
  return good;
}

Data Port<int>::write(const int& value, bool) { return Data(static_cast<double>(value)); }
Data Port<Counts3>::write(const Counts3& value, bool h) {
  return Data(DataList{design::write(value[0], h), design::write(value[1], h), design::write(value[2], h)});
}

namespace {

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

Data Port<Number>::write(const Number& value, bool for_hash) {
  if (const double* number = value.constant()) return Data(*number);
  if (const auto& source = value.expression()->source(); source && !for_hash) return Data(HostObjectPtr(source));
  if (!value.expression()->inputs().empty()) return write_formula(*value.expression());
  return Data(value.expression()->text());
}

PortText Port<Numbers3>::text(const Domain& domain) {
  if (domain.one_is_enough) return {"number or 3 numbers, or fields", "triples of fields", "Union[Number, Numbers]"};
  return {"3 numbers or fields", "triples of fields", "Numbers"};
}

bool Port<Numbers3>::read(const Data& data, const Domain& domain, Numbers3& value, const Reader& reader) {
  if (domain.one_is_enough && !data.list()) {
    value = {0, 0, 0};
    return design::read(data, domain, value.x, reader);
  }
  if (const auto outputs = vector_of(data, reader); outputs.size() == 3) {
    value = {outputs[0], outputs[1], outputs[2]};
    reader.keep(nodes_of(outputs[0]).front());
    return true;
  }
  if (!read_vector(data, domain, reader)) return false;
  const DataList& list = *data.list();
  const bool x = design::read(list[0], domain, value.x, reader), y = design::read(list[1], domain, value.y, reader),
             z = design::read(list[2], domain, value.z, reader);
  return x && y && z;
}

Data Port<Numbers3>::write(const Numbers3& v, bool h) {
  return Data(DataList{design::write(v.x, h), design::write(v.y, h), design::write(v.z, h)});
}

}  // namespace ombre::design
