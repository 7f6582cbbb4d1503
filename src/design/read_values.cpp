// Reads values of parameters from plain data.
#include <algorithm>

#include "base/system/assert.h"
#include "base/text/text.h"
#include "design/attributes.h"
#include "design/outputs.h"
#include "design/values.h"

namespace ombre::design {

std::vector<std::string> known_variables(const Domain& domain) {
  std::vector<std::string> known = expr::coordinate_names();
  known.insert(known.end(), domain.variables.begin(), domain.variables.end());
  return known;
}

void Reader::keep(const NodePtr& value) const {
  ASSERT(values && "parameters of nodes alone hold outputs");
  if (values->empty() || values->back() != value) values->push_back(value);
}

bool Reader::fail(const Data& data, const std::string& expected, const Phrase& given_hint, Code code) const {
  Phrase hint = given_hint;
  if (hint.empty() && is_value(data) && data.host_object())
    hint = "this varies in space, so it is known only where the job evaluates it; write a constant";
  std::string message = std::string(name) + " of " + std::string(node) + ": expected " + expected;
  if (!data.is_null()) message += ", found " + describe(data);
  diagnostics.error(code, data.where.source ? data.where : where, message, hint,
                    {{"node", std::string(node)},
                     {"parameter", std::string(name)},
                     {"expected", expected},
                     {"found", data.is_null() ? "" : describe(data)}});
  return false;
}

namespace {

std::string with_unit(const Domain& domain) { return domain.unit.empty() ? "" : " (" + std::string(domain.unit) + ")"; }

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

bool is_list(const Data& data, size_t size) { return data.list() && data.list()->size() == size; }

bool read_vector(const Data& data, const Domain& domain, const Reader& reader) {
  return is_list(data, 3) || reader.fail(data, "three numbers (x, y, z)" + with_unit(domain));
}

// Reads plain numbers, which most expressions are, without the parser.
std::optional<double> plain_number(const std::string& text) {
  const bool begins_one = !text.empty() && (text[0] == '-' || text[0] == '.' || (text[0] >= '0' && text[0] <= '9'));
  return begins_one ? parse_number(text) : std::nullopt;
}

}  // namespace

bool read(const Data& data, const Domain& domain, double& value, const Reader& reader) {
  const double* number = data.number();
  if (!number) return reader.fail(data, "a number" + with_unit(domain));
  const double near = without_noise(*number, domain);
  if (!in_range(near, domain)) {
    const std::string range = range_text(domain);
    return reader.fail(data, range.empty() ? "a finite number" : "a number " + range + with_unit(domain), {},
                       Code::parameter_range);
  }
  value = near;
  return true;
}

bool read(const Data& data, const Domain& domain, std::optional<double>& value, const Reader& reader) {
  value.reset();
  if (data.is_null()) return true;
  value.emplace();
  return read(data, domain, *value, reader);
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
  if (!read(Data(*constant, data.where), domain, number, reader)) return false;
  value = number;
  return true;
}

}  // namespace

bool read(const Data& data, const Domain& domain, Number& value, const Reader& reader) {
  double number = 0;
  if (const std::string* text = data.string()) {
    if (const auto plain = plain_number(*text)) {
      if (!read(Data(*plain, data.where), domain, number, reader)) return false;
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
  if (!data.number()) return reader.fail(data, "a number" + with_unit(domain) + " or an expression in quotes");
  if (!read(data, domain, number, reader)) return false;
  value = number;
  return true;
}

bool read(const Data& data, const Domain& domain, Numbers3& value, const Reader& reader) {
  if (domain.one_is_enough && !data.list()) {
    value = {0, 0, 0};
    return read(data, domain, value.x, reader);
  }
  if (!read_vector(data, domain, reader)) return false;
  const DataList& list = *data.list();
  const bool x = read(list[0], domain, value.x, reader), y = read(list[1], domain, value.y, reader),
             z = read(list[2], domain, value.z, reader);
  return x && y && z;
}

bool read(const Data& data, const Domain&, bool& value, const Reader& reader) {
  if (!data.boolean()) return reader.fail(data, "true or false");
  value = *data.boolean();
  return true;
}

bool read(const Data& data, const Domain&, std::string& value, const Reader& reader) {
  if (!data.string()) return reader.fail(data, "a text in quotes");
  value = *data.string();
  return true;
}

bool read(const Data& data, const Domain& domain, Choice& value, const Reader& reader) {
  if (!data.string()) return reader.fail(data, "a text in quotes");
  const std::string folded = fold_name(*data.string());
  for (const std::string& choice : domain.choices)
    if (fold_name(choice) == folded) {
      value = choice.c_str();
      return true;
    }
  return reader.fail(data, "one of \"" + join(domain.choices, "\", \"") + "\"",
                     did_you_mean(*data.string(), domain.choices), Code::parameter_range);
}

bool read(const Data& data, const Domain& domain, Vec3& value, const Reader& reader) {
  if (!read_vector(data, domain, reader)) return false;
  const DataList& list = *data.list();
  const bool x = read(list[0], domain, value.x, reader), y = read(list[1], domain, value.y, reader),
             z = read(list[2], domain, value.z, reader);
  return x && y && z;
}

bool read(const Data& data, const Domain& domain, std::optional<Vec3>& value, const Reader& reader) {
  value.reset();
  if (data.is_null()) return true;
  value.emplace();
  return read(data, domain, *value, reader);
}

bool read(const Data& data, const Domain& domain, Affine& value, const Reader& reader) {
  const std::string expected = "a matrix of 3 or 4 rows with 4 numbers each";
  const DataList* rows = data.list();
  if (!rows || rows->size() < 3 || rows->size() > 4) return reader.fail(data, expected);
  for (size_t r = 0; r < rows->size(); ++r) {
    if (!is_list((*rows)[r], 4)) return reader.fail((*rows)[r], expected);
    for (size_t c = 0; c < 4; ++c) {
      double number = 0;
      if (!read((*(*rows)[r].list())[c], domain, number, reader)) return false;
      if (r == 3) {
        if (number != (c == 3 ? 1 : 0)) return reader.fail((*rows)[3], "0, 0, 0, 1 as the last row");
      } else if (c == 3) {
        value.offset[static_cast<int>(r)] = number;
      } else {
        value.rows[r][static_cast<int>(c)] = number;
      }
    }
  }
  return true;
}

bool read(const Data& data, const Domain& domain, MaterialName& value, const Reader& reader) {
  value = {};
  if (is_value(data)) {
    if (!domain.may_mix)
      return reader.fail(data, "a material's name",
                         "one material is meant here; values mix several by " +
                             spelled::around("fgrade", {{"", "[1 - t, t]"}, {"", "[red, blue]"}}));
    const NodePtr node = read_mixture(data, reader);
    if (!node) return false;
    reader.keep(node);
    value.mixture = node.get();
    return true;
  }
  if (const double* id = data.number()) {
    const bool is_id = *id >= 0 && *id <= 255 && *id == std::floor(*id);
    const Material* material = is_id ? reader.materials.find(static_cast<MaterialId>(*id)) : nullptr;
    if (!material)
      return reader.fail(
          data, "a material's name, or its number from 0 to " + std::to_string(reader.materials.all().size() - 1));
    value.material = material;
    return true;
  }
  if (!data.string()) return reader.fail(data, "a material's name");
  if (data.string()->empty()) {
    value.material = &reader.materials.first();
    return true;
  }
  if (const Material* material = reader.materials.find(*data.string())) {
    value.material = material;
    return true;
  }
  const auto names = reader.materials.names();
  std::string hint = did_you_mean(*data.string(), names);
  if (hint.empty()) hint = "there are " + join(names, ", ");
  reader.diagnostics.error(
      Code::unknown_material, data.where.source ? data.where : reader.where,
      "there is no material \"" + *data.string() + "\"", hint,
      {{"material", *data.string()}, {"similar", closest_name(*data.string(), names).value_or("")}});
  return false;
}

// A text is a material if there is one of that name, else an expression.
bool read(const Data& data, const Domain& domain, NumberOrMaterial& value, const Reader& reader) {
  value = {};
  const bool is_name = data.string() && reader.materials.find(*data.string());
  if (!is_name && !is_mixture(data)) return read(data, domain, value.number, reader);
  Domain of_material;
  of_material.may_mix = true;
  return read(data, of_material, value.material, reader);
}

bool read(const Data& data, const Domain&, FilePath& value, const Reader& reader) {
  if (!data.string() || data.string()->empty()) return reader.fail(data, "the path of a file");
  value.path = *data.string();
  return true;
}

namespace {

// A single element counts as a list of one element.
template <class T>
bool read_list(const Data& data, const Domain& domain, SharedList<T>& value, const Reader& reader) {
  const std::span<const Data> elements = data.list() ? std::span<const Data>(*data.list()) : std::span(&data, 1);
  std::vector<T> list(elements.size());
  bool good = true;
  for (size_t i = 0; i < list.size(); ++i) good = read(elements[i], domain, list[i], reader) && good;
  value = SharedList<T>(std::move(list));
  return good;
}

}  // namespace

bool read(const Data& data, const Domain& domain, SharedList<Number>& value, const Reader& reader) {
  return read_list(data, domain, value, reader);
}

bool read(const Data& data, const Domain& domain, SharedList<MaterialName>& value, const Reader& reader) {
  return read_list(data, domain, value, reader);
}

namespace {

bool read_pair(const Data& data, const Domain& domain, MaterialForName& value, const Reader& reader) {
  if (!is_list(data, 2) || !data.list()->front().string())
    return reader.fail(data, "pairs of a name in the file and a material", "write for example [[\"PLA\", \"red\"]]");
  value.name = *data.list()->front().string();
  return read(data.list()->back(), domain, value.material, reader);
}

}  // namespace

bool read(const Data& data, const Domain& domain, std::vector<MaterialStop>& value, const Reader& reader) {
  value.clear();
  const auto is_pair = [](const Data& element) { return is_list(element, 2) && element.list()->front().number(); };
  if (!data.list()) return reader.fail(data, "a list of numbers with materials");
  for (const Data& element : *data.list()) {
    if (!is_pair(element))
      return reader.fail(element, "pairs of a number and a material",
                         "write for example [[0, \"clear\"], [100, \"red\"]]");
    MaterialStop& stop = value.emplace_back();
    if (!read(element.list()->front(), unit::none, stop.at, reader)) return false;
    if (!read(element.list()->back(), domain, stop.material, reader)) return false;
  }
  return true;
}

bool read(const Data& data, const Domain& domain, std::vector<MaterialForName>& value, const Reader& reader) {
  value.clear();
  const bool is_pair = data.list() && !data.list()->empty() && !data.list()->front().list();
  if (!data.list() || is_pair) {
    value.emplace_back();
    return read_pair(data, domain, value.back(), reader);
  }
  bool good = true;
  for (const Data& element : *data.list()) {
    value.emplace_back();
    good = read_pair(element, domain, value.back(), reader) && good;
  }
  return good;
}

namespace {

bool read_edge(const Data& data, const Domain& domain, Edge& edge, const Reader& reader) {
  const DataList* parts = data.list();
  if (!parts || parts->size() < 2 || parts->size() > 3)
    return reader.fail(
        data, "edges of two points (mm), each with a radius if it has its own",
        "write for example " + spelled::value("[[(0, 0, 0), (10, 0, 0)], [(0, 0, 0), (0, 10, 0), 0.5]]"));
  if (!read((*parts)[0], domain, edge.start, reader) || !read((*parts)[1], domain, edge.end, reader)) return false;
  if (edge.start == edge.end) return reader.fail(data, "edges with two different ends");
  if (parts->size() == 2) return true;
  return read((*parts)[2], unit::positive_mm, edge.radius, reader);
}

}  // namespace

bool read(const Data& data, const Domain& domain, std::optional<std::vector<Edge>>& value, const Reader& reader) {
  if (!data.list()) return reader.fail(data, "a list of edges");
  std::vector<Edge>& edges = value.emplace();
  edges.reserve(data.list()->size());
  bool good = true;
  for (const Data& element : *data.list()) {
    edges.emplace_back();
    good = read_edge(element, domain, edges.back(), reader) && good;
  }
  return good;
}

}  // namespace ombre::design
