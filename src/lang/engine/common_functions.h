// The builtin functions that all languages have. `Call` is a language's call of a function: call[0] is an argument,
// call.all() are all of them, and call.expected() says what an argument should be, and throws or returns what the
// function then gives.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/math/degrees.h"
#include "base/math/math.h"
#include "base/text/utf8.h"
#include "lang/engine/value.h"

namespace ombre::lang {

template <class Call>
struct CommonFunction {
  const char* name;
  std::vector<const char*> parameters;  // all are needed
  bool is_variadic;                     // any number of further arguments may follow
  Value (*call)(const Call& call);
};

namespace common {

template <double (*function)(double), class Call>
Value of_number(const Call& call) {
  const double* x = call[0].number();
  return x ? Value(function(*x)) : call.expected(0, "a number");
}

template <double (*function)(double, double), class Call>
Value of_two(const Call& call) {
  const double *x = call[0].number(), *y = call[1].number();
  return x && y ? Value(function(*x, *y)) : call.expected(x ? 1 : 0, "a number");
}

// Returns the logarithm with base 10, or with the first of two arguments as base.
template <class Call>
Value logarithm(const Call& call) {
  const double *x = call[0].number(), *y = call.size() == 2 ? call[1].number() : x;
  if (!x || !y) return call.expected(x ? 1 : 0, "a number");
  return call.size() == 2 ? math::log(*y) / math::log(*x) : math::log10(*x);
}

template <bool (*test)(const Value&), class Call>
Value of_value(const Call& call) {
  return test(call[0]);
}

template <class Call>
Value len(const Call& call) {
  if (const List* list = call[0].list()) return static_cast<double>(list->items.size());
  const Text* text = call[0].text();
  if (!text) return call.expected(0, "a list or a string");
  call.meter.spend(text->text.size() / 16);
  return static_cast<double>(count_code_points(text->text));
}

// Joins lists, and appends other values.
template <class Call>
Value concat(const Call& call) {
  ListBuilder result(call.meter);
  for (const Value& argument : call.all()) {
    const List* list = argument.list();
    if (!list) {
      result.push(argument);
      continue;
    }
    call.meter.spend(list->items.size());
    for (const Value& item : list->items) result.push(item);
  }
  return result.finish();
}

// Interpolates linearly between the pairs of a key and a value that `pair` returns for rows, which is null for rows to
// leave out; constant beyond them.
template <class Pair>
Value lookup(double key, const List& table, const Pair& pair) {
  const List *below = nullptr, *above = nullptr;
  const auto key_of = [](const List* row) { return *row->items[0].number(); };
  const auto value_of = [](const List* row) { return *row->items[1].number(); };
  for (const Value& row : table.items) {
    const List* next = pair(row);
    if (!next) continue;
    if (key_of(next) <= key && (!below || key_of(next) > key_of(below))) below = next;
    if (key_of(next) >= key && (!above || key_of(next) < key_of(above))) above = next;
  }
  if (!below) return above ? Value(value_of(above)) : Value();
  if (!above || key_of(above) == key_of(below)) return value_of(below);
  const double part = (key - key_of(below)) / (key_of(above) - key_of(below));
  return value_of(below) * (1 - part) + value_of(above) * part;
}

// Appends the character of a code point, if there is one.
inline void append_character(std::string& text, double code, Meter& meter) {
  meter.spend();
  meter.check_text(text.size());
  const double whole = std::trunc(code);
  if (is_code_point(whole)) append_code_point(text, static_cast<uint32_t>(whole));
}

// Adds what search() gives for one value: the place itself where one is wanted, else a list of all places. Without a
// place, `keeps_empty` says whether an empty list is added.
inline void push_places(const std::vector<double>& places, bool wants_one, bool keeps_empty, ListBuilder& result,
                        Meter& meter) {
  if (wants_one && !places.empty()) return result.push(places.front());
  if (!wants_one || keeps_empty) result.push(make_list(places, meter));
}

inline double absolute(double x) { return std::abs(x); }
inline double rounded(double x) { return std::round(x); }
inline double rounded_up(double x) { return std::ceil(x); }
inline double rounded_down(double x) { return std::floor(x); }
inline double root(double x) { return std::sqrt(x); }
inline double exponential(double x) { return math::exp(x); }
inline double natural_logarithm(double x) { return math::log(x); }
inline double power(double x, double y) { return math::pow(x, y); }

inline bool is_undef(const Value& value) { return value.is_undef(); }
inline bool is_bool(const Value& value) { return value.boolean() != nullptr; }
inline bool is_num(const Value& value) { return value.number() && !std::isnan(*value.number()); }
inline bool is_string(const Value& value) { return value.text() != nullptr; }
inline bool is_list(const Value& value) { return value.list() != nullptr; }
inline bool is_function(const Value& value) { return value.closure() != nullptr; }

}  // namespace common

template <class Call>
std::vector<CommonFunction<Call>> common_functions() {
  using namespace common;
  return {{"abs", {"x"}, false, of_number<absolute>},
          {"sin", {"degrees"}, false, of_number<degrees::sine>},
          {"cos", {"degrees"}, false, of_number<degrees::cosine>},
          {"tan", {"degrees"}, false, of_number<degrees::tangent>},
          {"asin", {"x"}, false, of_number<degrees::arc_sine>},
          {"acos", {"x"}, false, of_number<degrees::arc_cosine>},
          {"atan", {"x"}, false, of_number<degrees::arc_tangent>},
          {"atan2", {"y", "x"}, false, of_two<degrees::arc_tangent2>},
          {"floor", {"x"}, false, of_number<rounded_down>},
          {"ceil", {"x"}, false, of_number<rounded_up>},
          {"round", {"x"}, false, of_number<rounded>},
          {"ln", {"x"}, false, of_number<natural_logarithm>},
          {"exp", {"x"}, false, of_number<exponential>},
          {"pow", {"base", "exponent"}, false, of_two<power>},
          {"sqrt", {"x"}, false, of_number<root>},
          {"len", {"value"}, false, len},
          {"concat", {}, true, concat},
          {"is_undef", {"value"}, false, of_value<is_undef>},
          {"is_bool", {"value"}, false, of_value<is_bool>},
          {"is_num", {"value"}, false, of_value<is_num>},
          {"is_string", {"value"}, false, of_value<is_string>},
          {"is_list", {"value"}, false, of_value<is_list>},
          {"is_function", {"value"}, false, of_value<is_function>}};
}

}  // namespace ombre::lang
