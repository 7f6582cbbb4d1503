#include "design/ports/attribute_value.h"

#include <algorithm>
#include <charconv>

#include "base/text/text.h"
#include "design/outputs.h"

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
  return design::read(data, domain, value.mixture, reader);
}

bool read_numbers(const DataList& list, const Domain& domain, AttributeValue& value, const Reader& reader) {
  value.type = list.size() == 3 ? ValueType::vector : ValueType::colour;
  bool good = true;
  for (size_t n = 0; n < list.size(); ++n) good = design::read(list[n], domain, value.numbers[n], reader) && good;
  return good;
}

}  // namespace

std::span<const Number> AttributeValue::used() const { return {numbers.data(), numbers_in(type)}; }

bool Port<AttributeValue>::read(const Data& data, const Domain& domain, AttributeValue& value, const Reader& reader) {
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
  if (vector.empty()) return design::read(data, domain, value.numbers[0], reader);
  value.type = vector.size() == 3 ? ValueType::vector : ValueType::colour;
  for (size_t n = 0; n < vector.size(); ++n) value.numbers[n] = vector[n];
  reader.keep(nodes_of(vector[0]).front());
  return true;
}

Data Port<AttributeValue>::write(const AttributeValue& value, bool for_hash) {
  if (value.type == ValueType::number) return design::write(value.numbers[0], for_hash);
  if (value.type == ValueType::mixture) return design::write(value.mixture, for_hash);
  DataList list;
  for (const Number& number : value.used()) list.push_back(design::write(number, for_hash));
  return Data(std::move(list));
}

}  // namespace ombre::design
