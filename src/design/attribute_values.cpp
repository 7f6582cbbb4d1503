// Parameters that are values of attributes, solids, or rows of numbers.
#include <algorithm>
#include <charconv>

#include "base/text/text.h"
#include "design/outputs.h"
#include "design/values.h"

namespace ombre::design {
namespace {

size_t numbers_in(ValueType type) {
  switch (type) {
    case ValueType::number:
      return 1;
    case ValueType::vector:
      return 3;
    case ValueType::colour:
      return 4;
    case ValueType::mixture:
    case ValueType::label:  // attributes of designs cannot be labels
      break;
  }
  return 0;
}

// Reads a colour, "#rrggbb" or "#rrggbbaa".
std::optional<std::array<Number, 4>> colour_of(const std::string& text) {
  if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
  std::array<Number, 4> colour{0, 0, 0, 1};
  for (size_t n = 0; 2 * n + 2 < text.size(); ++n) {
    unsigned byte = 0;
    const char* digits = text.data() + 2 * n + 1;
    const auto [end, status] = std::from_chars(digits, digits + 2, byte, 16);
    if (status != std::errc() || end != digits + 2) return std::nullopt;
    colour[n] = byte / 255.0;
  }
  return colour;
}

bool read_mixed(const Data& data, AttributeValue& value, const Reader& reader) {
  Domain domain;
  domain.may_mix = true;
  value.type = ValueType::mixture;
  return read(data, domain, value.mixture, reader);
}

bool read_numbers(const DataList& list, const Domain& domain, AttributeValue& value, const Reader& reader) {
  value.type = list.size() == 3 ? ValueType::vector : ValueType::colour;
  bool good = true;
  for (size_t n = 0; n < list.size(); ++n) good = read(list[n], domain, value.numbers[n], reader) && good;
  return good;
}

}  // namespace

std::span<const Number> AttributeValue::used() const { return {numbers.data(), numbers_in(type)}; }

bool read(const Data& data, const Domain& domain, AttributeValue& value, const Reader& reader) {
  value = {};
  if (is_mixture(data)) return read_mixed(data, value, reader);
  if (const std::string* text = data.string()) {
    if (reader.materials.find(*text)) return read_mixed(data, value, reader);
    if (const auto colour = colour_of(*text)) {
      value.type = ValueType::colour;
      value.numbers = *colour;
      return true;
    }
    if (!text->empty() && text->front() == '#')
      return reader.fail(data, "a colour such as \"#ff8800\" or \"#ff880080\"");
  }
  if (const DataList* list = data.list()) {
    if (list->size() == 3 || list->size() == 4) return read_numbers(*list, domain, value, reader);
    return reader.fail(data, "a number, three of a vector, four of a colour, or a mixture of materials");
  }
  const std::vector<expr::Expression> vector = vector_of(data, reader);
  if (vector.empty()) return read(data, domain, value.numbers[0], reader);
  value.type = ValueType::vector;
  for (size_t n = 0; n < vector.size(); ++n) value.numbers[n] = vector[n];
  reader.keep(nodes_of(vector[0]).front());
  return true;
}

Data write(const AttributeValue& value, bool for_hash) {
  if (value.type == ValueType::number) return write(value.numbers[0], for_hash);
  if (value.type == ValueType::mixture) return write(value.mixture, for_hash);
  DataList list;
  for (const Number& number : value.used()) list.push_back(write(number, for_hash));
  return Data(std::move(list));
}

bool read(const Data& data, const Domain&, SolidName& value, const Reader& reader) {
  const NodePtr node = read_solid(data, reader);
  if (!node) return false;
  reader.keep(node);
  value.node = node.get();
  return true;
}

Data write(const SolidName& value, bool) { return value.node ? write_solid(*value.node) : Data(); }

bool read(const Data& data, const Domain& domain, std::vector<NamedWord>& value, const Reader& reader) {
  value.clear();
  const auto is_pair = [](const Data& one) {
    return one.list() && one.list()->size() == 2 && (*one.list())[0].string() && (*one.list())[1].string();
  };
  const std::string expected = "pairs of a name and one of \"" + join(domain.choices, "\", \"") + "\"";
  const std::span<const Data> pairs = is_pair(data) ? std::span(&data, 1)
                                      : data.list() ? std::span<const Data>(*data.list())
                                                    : std::span<const Data>();
  if (!data.list()) return reader.fail(data, expected);
  for (const Data& pair : pairs) {
    if (!is_pair(pair)) return reader.fail(pair, expected);
    const std::string &name = *(*pair.list())[0].string(), &word = *(*pair.list())[1].string();
    if (std::ranges::find(domain.choices, word) == domain.choices.end())
      return reader.fail((*pair.list())[1], "one of \"" + join(domain.choices, "\", \"") + "\"",
                         did_you_mean(word, domain.choices));
    value.push_back({name, word});
  }
  return true;
}

Data write(const std::vector<NamedWord>& value, bool) {
  DataList list;
  for (const NamedWord& pair : value) list.emplace_back(DataList{Data(pair.name), Data(pair.word)});
  return Data(std::move(list));
}

namespace {

bool read_row(const Data& data, std::vector<double>& row, const Reader& reader) {
  if (!data.list()) return reader.fail(data, "rows of numbers", "write for example [[0, 1], [10, 5]]");
  for (const Data& element : *data.list()) {
    row.push_back(0);
    if (!read(element, any(), row.back(), reader)) return false;
  }
  return true;
}

}  // namespace

bool read(const Data& data, const Domain& domain, NumberTable& value, const Reader& reader) {
  value = {};
  if (data.string()) return read(data, domain, value.file, reader);
  if (!data.list()) return reader.fail(data, "rows of numbers, or the path of a CSV file");
  for (const Data& element : *data.list()) {
    value.rows.emplace_back();
    if (!read_row(element, value.rows.back(), reader)) return false;
  }
  return true;
}

Data write(const NumberTable& value, bool for_hash) {
  if (!value.file.path.empty()) return write(value.file, for_hash);
  DataList list;
  for (const auto& row : value.rows) {
    DataList numbers;
    for (const double number : row) numbers.emplace_back(number);
    list.emplace_back(std::move(numbers));
  }
  return Data(std::move(list));
}

bool read(const Data& data, const Domain&, ScriptVariables& value, const Reader& reader) {
  value = {};
  if (data.is_null()) return true;
  if (!data.members()) return reader.fail(data, "values by name", "write for example {\"width\": 20}");
  value.values = *data.members();
  return true;
}

Data write(const ScriptVariables& value, bool) { return Data(value.values); }

}  // namespace ombre::design
