#include "design/ports/numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text/text.h"
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

std::string_view name_of(InSpace in_space) {
  constexpr std::array<std::string_view, 7> names{"", "point", "profile", "direction", "offset", "radius", "surface"};
  return names[static_cast<size_t>(in_space)];
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
