#include "lang/engine/argument_check.h"

#include <algorithm>
#include <cmath>

#include "base/text/text.h"

namespace ombre::lang {
namespace {

bool is_object(const Value& value, Object::Form form) { return value.object() && value.object()->form() == form; }

bool is_number(const Value& value) { return value.number() && std::isfinite(*value.number()); }
bool is_radius(const Value& value) { return is_number(value) && *value.number() >= 0; }
bool is_length(const Value& value) { return is_number(value) && *value.number() > 0; }
bool is_numeric(const Value& value) { return is_number(value) || is_object(value, Object::Form::value); }

// Operators take solids for the region inside them (data/library/ombre/regions.vcad).
bool is_region(const Value& value) {
  return is_numeric(value) || value.boolean() || (value.record() && value.record()->find("inside")) ||
         is_object(value, Object::Form::solid);
}

bool is_numeric_list(const Value& value) {
  return value.range() || (value.list() && std::ranges::all_of(value.list()->items, is_numeric));
}

bool is_place(const Value& value) { return is_numeric_list(value) && value.list() && value.list()->items.size() == 3; }

bool is_direction(const Value& value) {
  const auto is_zero = [](const Value& item) { return item.number() && *item.number() == 0; };
  return is_place(value) && !std::ranges::all_of(value.list()->items, is_zero);
}

// Points have two numbers or more.
bool is_list_of_points(const Value& value) {
  return value.list() && std::ranges::all_of(value.list()->items, [](const Value& item) {
           return item.list() && item.list()->items.size() >= 2 && is_numeric_list(item);
         });
}

bool is_mixture(const Value& value) { return value.text() || is_object(value, Object::Form::mixture); }

struct PortType {
  std::string_view name, expected;
  bool (*fits)(const Value& value);
};

constexpr PortType types[] = {
    {"number", "a number", is_number},
    {"value", "a number or a value that varies in space", is_numeric},
    {"vector", "a list of numbers", is_numeric_list},
    {"colour", "the name of a colour or a list of numbers",
     [](const Value& value) { return value.text() || is_numeric_list(value); }},
    {"mixture", "a material or a mixture", is_mixture},
    {"material", "a material or a mixture", is_mixture},
    {"text", "a text", [](const Value& value) { return value.text() != nullptr; }},
    {"image", "the path of an image", [](const Value& value) { return value.text() != nullptr; }},
    {"solid", "a solid", [](const Value& value) { return is_object(value, Object::Form::solid); }},
    {"region", "a region: a value that is 1 inside, an object with \"inside\", or a solid", is_region},
    {"frame", "a frame", [](const Value& value) { return value.record() || value.object() || value.list(); }},
    {"curve", "a list of points", [](const Value& value) { return value.record() || is_list_of_points(value); }},
    {"points", "a list of points", is_list_of_points},
    {"point", "three numbers", is_place},
    {"direction", "three numbers that are not all 0", is_direction},
    {"radius", "a number of 0 or more", is_radius},
    {"length", "a number above 0", is_length},
    {"index", "an index: numbers that count cells",
     [](const Value& value) { return is_numeric(value) || is_numeric_list(value); }},
    {"truth", "true or false", [](const Value& value) { return value.boolean() != nullptr; }},
};

bool is_choice(const DeclaredParameter& parameter, const Value& value) {
  return std::ranges::any_of(parameter.choices, [&](const auto& choice) {
    const Data& allowed = choice.first;
    if (value.text() && allowed.string()) return value.text()->text == *allowed.string();
    return value.number() && allowed.number() && *value.number() == *allowed.number();
  });
}

bool is_in_range(const DeclaredParameter& parameter, const Value& value) {
  if (const List* list = value.list())
    return std::ranges::all_of(list->items, [&](const Value& item) { return is_in_range(parameter, item); });
  const double* number = value.number();
  return !number ||
         (!(parameter.least && *number < *parameter.least) && !(parameter.most && *number > *parameter.most));
}

std::string range_text(const DeclaredParameter& parameter) {
  const auto text = [](double number) { return format_number(number); };
  if (parameter.least && parameter.most) return " from " + text(*parameter.least) + " to " + text(*parameter.most);
  if (parameter.least) return " of at least " + text(*parameter.least);
  return parameter.most ? " up to " + text(*parameter.most) : "";
}

std::string choices_text(const DeclaredParameter& parameter) {
  std::vector<std::string> names;
  for (const auto& [value, label] : parameter.choices)
    names.push_back(value.string() ? '"' + *value.string() + '"' : format_number(*value.number()));
  return "one of " + join(names, ", ");
}

std::string expected_text(const DeclaredParameter& parameter, std::string_view expected) {
  if (!parameter.choices.empty()) return choices_text(parameter);
  const std::string range = range_text(parameter);
  const bool is_limited_number = parameter.type == "value" && !range.empty();
  std::string text = (is_limited_number ? "a number" : std::string(expected)) + range;
  if (!parameter.unit.empty()) text += " (" + parameter.unit + ')';
  return text;
}

std::string found_text(const Value& value) {
  constexpr size_t longest = 40, most_items = 4;
  const auto is_a_number = [](const Value& item) { return item.number() != nullptr; };
  if (const List* list = value.list();
      list && list->items.size() <= most_items && std::ranges::all_of(list->items, is_a_number)) {
    std::vector<std::string> items;
    for (const Value& item : list->items) items.push_back(number_text(*item.number()));
    return '[' + join(items, ", ") + ']';
  }
  if (value.number()) return number_text(*value.number());
  if (value.boolean()) return *value.boolean() ? "true" : "false";
  if (value.text() && value.text()->text.size() <= longest) return '"' + value.text()->text + '"';
  return describe(value);
}

}  // namespace

bool names_material(const DeclaredParameter& parameter) {
  return parameter.type == "material" || parameter.type == "mixture";
}

std::string mismatch_of(const DeclaredParameter& parameter, const Value& value) {
  if (value.is_undef()) return "";  // stands for the default, or for nothing
  const auto* type = std::ranges::find(types, parameter.type, &PortType::name);
  const bool fits = type == std::end(types) || type->fits(value);
  const bool is_allowed = parameter.choices.empty() ? is_in_range(parameter, value) : is_choice(parameter, value);
  if (fits && is_allowed) return "";
  const std::string_view expected = type == std::end(types) ? "a value" : type->expected;
  return "expected " + expected_text(parameter, expected) + ", found " + found_text(value);
}

}  // namespace ombre::lang
