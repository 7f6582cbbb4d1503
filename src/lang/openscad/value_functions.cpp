// Functions of strings, vectors and any values.
#include <array>
#include <cmath>

#include "base/text/utf8.h"
#include "lang/openscad/ranges.h"
#include "lang/openscad/script_functions.h"
#include "lang/openscad/value_text.h"

namespace ombre::lang::openscad {
namespace {

using Call = FunctionCall;

Value str(const Call& call) {
  std::string text;
  for (const Value& argument : call.arguments) append_value(text, argument, false, call.meter);
  return make_text(std::move(text), call.meter);
}

// Appends the characters of numbers in nested lists and ranges.
void append_characters(const Value& value, Meter& meter, std::string& text) {
  if (const double* code = value.number()) common::append_character(text, *code, meter);
  if (const List* list = value.list())
    for (const Value& item : list->items) append_characters(item, meter, text);
  const Range* range = value.range();
  if (!range || element_count(*range) >= most_range_elements) return;
  for (double i = 0; i < element_count(*range); ++i) common::append_character(text, range->at(i), meter);
}

Value chr(const Call& call) {
  std::string text;
  for (const Value& argument : call.arguments) append_characters(argument, call.meter, text);
  return make_text(std::move(text), call.meter);
}

Value ord(const Call& call) {
  if (call.size() == 0) return {};
  if (call.size() > 1)
    return call.fail("ord() called with " + std::to_string(call.size()) + " arguments, only 1 argument expected");
  const Text* text = call[0].text();
  if (!text) return call.fail("ord() argument " + value_text(call[0], true, call.meter) + " is not of type string");
  if (text->text.empty()) return {};
  if (code_point_size(text->text, 0) == 0)
    return call.fail("ord() argument '" + text->text + "' is not a valid utf8 string");
  return static_cast<double>(code_point(text->text, 0));
}

// Rows that are not pairs of numbers are left out.
Value lookup(const Call& call) {
  const double* key = call[0].number();
  if (!key || !std::isfinite(*key))
    return call.fail("lookup(" + value_text(call[0], true, call.meter) + ", ...) first argument is not a number");
  const auto pair = [&](const Value& row) -> const List* {
    call.meter.spend();
    const List* list = row.list();
    return list && list->items.size() == 2 && is_number_list(*list) ? list : nullptr;
  };
  const List* table = call[1].list();
  if (!table || table->items.empty() || !pair(table->items.front())) return {};
  return common::lookup(*key, *table, pair);
}

// Finds the positions of values in a vector or string.
class Search {
 public:
  explicit Search(const Call& call)
      : call_(call), most_(call.size() > 2 ? whole(call[2], 1) : 1), column_(call.size() > 3 ? whole(call[3], 0) : 0) {}

  Value run() {
    const Value &wanted = call_[0], &table = call_[1];
    if (wanted.number()) return of_value(wanted);
    if (const Text* text = wanted.text()) {
      if (table.text()) return of_characters(text->text, table.text()->text);
      return of_rows(text->text);
    }
    return wanted.list() ? of_values(*wanted.list()) : Value();
  }

 private:
  static double whole(const Value& value, double otherwise) {
    return value.number() && std::isfinite(*value.number()) ? std::trunc(*value.number()) : otherwise;
  }

  const List* table() const { return call_[1].list(); }
  bool has_all(size_t found) const { return most_ > 0 && static_cast<double>(found) >= most_; }

  static std::vector<std::string> characters(const std::string& text) {
    std::vector<std::string> result;
    for (size_t at = 0; at < text.size();) {
      const size_t size = character_size(text, at);
      result.push_back(text.substr(at, size));
      at += size;
    }
    return result;
  }

  const Value* in_column(const Value& row) const {
    const List* list = row.list();
    const bool has_it = list && column_ >= 0 && column_ < static_cast<double>(list->items.size());
    return has_it ? &list->items[static_cast<size_t>(column_)] : nullptr;
  }

  void push(const std::vector<double>& places, bool keeps_empty, ListBuilder& result) const {
    common::push_places(places, most_ == 1, keeps_empty, result, call_.meter);
  }

  std::vector<double> places_of(const Value& wanted, bool takes_columns_only) const {
    std::vector<double> places;
    if (!table()) return places;
    for (size_t i = 0; i < table()->items.size() && !has_all(places.size()); ++i) {
      const Value& row = table()->items[i];
      const Value* cell = in_column(row);
      if ((!takes_columns_only && equal(row, wanted, call_.meter)) || (cell && equal(*cell, wanted, call_.meter)))
        places.push_back(static_cast<double>(i));
    }
    return places;
  }

  Value of_value(const Value& wanted) const { return make_list(places_of(wanted, false), call_.meter); }

  Value of_values(const List& wanted) const {
    ListBuilder result(call_.meter);
    for (const Value& value : wanted.items) push(places_of(value, column_ != 0), true, result);
    return result.finish();
  }

  Value of_characters(const std::string& wanted, const std::string& text) const {
    const std::vector<std::string> all = characters(text);
    ListBuilder result(call_.meter);
    for (const std::string& character : characters(wanted)) {
      std::vector<double> places;
      for (size_t i = 0; i < all.size() && !has_all(places.size()); ++i) {
        call_.meter.spend();
        if (all[i] == character) places.push_back(static_cast<double>(i));
      }
      push(places, false, result);
    }
    return result.finish();
  }

  // Compares each character with the first one of the strings in a column. A row without that column ends the search.
  Value of_rows(const std::string& wanted) const {
    ListBuilder result(call_.meter);
    for (const std::string& character : characters(wanted)) {
      std::vector<double> places;
      for (size_t i = 0; table() && i < table()->items.size() && !has_all(places.size()); ++i) {
        call_.meter.spend();
        const Value* cell = in_column(table()->items[i]);
        if (!cell) return wrong_row(i);
        const Text* text = cell->text();
        if (text && text->text.substr(0, character_size(text->text, 0)) == character)
          places.push_back(static_cast<double>(i));
      }
      if (places.empty()) call_.fail("search term not found: \"" + character + '"');
      push(places, false, result);
    }
    return result.finish();
  }

  Value wrong_row(size_t index) const {
    call_.fail("Invalid entry in search vector at index " + std::to_string(index) +
               ", required number of values in the entry: " + number_text(column_ + 1) +
               ". Invalid entry: " + value_text(table()->items[index], true, call_.meter));
    return ListBuilder(call_.meter).finish();
  }

  const Call& call_;
  double most_, column_;
};

Value search(const Call& call) { return Search(call).run(); }

// The version of OpenSCAD whose language is implemented.
constexpr std::array<double, 3> release{2021, 1, 0};

Value version(const Call& call) { return make_list({release.begin(), release.end()}, call.meter); }

// Returns for example 20190500 for [2019, 5].
Value version_num(const Call& call) {
  std::array<double, 3> parts = release;
  if (call.size() > 0) {
    const List* list = call[0].list();
    if (!list || list->items.size() < 2 || list->items.size() > 3 || !is_number_list(*list)) return {};
    parts = {};
    for (size_t i = 0; i < list->items.size(); ++i) parts[i] = *list->items[i].number();
  }
  return parts[0] * 10000 + parts[1] * 100 + parts[2];
}

Value parent_module(const Call& call) {
  double index = 1;
  if (call.size() == 1) {
    if (!call[0].number()) return {};
    index = std::trunc(*call[0].number());
  }
  const std::string shown = number_text(index);
  if (index < 0) return call.fail("Negative parent module index (" + shown + ") not allowed");
  if (index >= static_cast<double>(call.modules.size()))
    return call.fail("Parent module index (" + shown + ") greater than the number of modules on the stack");
  return make_text(call.modules[call.modules.size() - 1 - static_cast<size_t>(index)]->name.text(), call.meter);
}

}  // namespace

std::vector<NamedFunction> value_functions() {
  return {{"str", str},
          {"chr", chr},
          {"ord", ord},
          {"lookup", lookup, 2, 2, true},
          {"search", search, 2, 4},
          {"version", version},
          {"version_num", version_num},
          {"parent_module", parent_module, 0, 1}};
}

}  // namespace ombre::lang::openscad
