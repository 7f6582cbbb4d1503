// Builtin functions of numbers, and those that test the type of a value.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/math/math.h"
#include "lang/engine/builtins.h"
#include "lang/engine/degrees.h"

namespace ombre::lang {

double BuiltinCall::number(size_t i) const {
  const double* value = arguments_[i].number();
  if (!value) expected(i, "a number");
  return *value;
}

const List& BuiltinCall::list(size_t i) const {
  const List* value = arguments_[i].list();
  if (!value) expected(i, "a list");
  return *value;
}

const std::string& BuiltinCall::text(size_t i) const {
  const Text* value = arguments_[i].text();
  if (!value) expected(i, "a string");
  return value->text;
}

void BuiltinCall::expected(size_t i, const std::string& what, const Phrase& hint) const {
  throw BadArgument{i, std::string(name_) + "() needs " + what + ", found " + describe(arguments_[i]),
                    hint.empty() ? Phrase(hint_for(arguments_[i])) : hint};
}

std::string Builtin::signature() const {
  std::string text = std::string(name) + '(';
  for (size_t i = 0; i < parameters.size(); ++i) {
    text += i > 0 ? ", " : "";
    text += i < required ? parameters[i] : '[' + std::string(parameters[i]) + ']';
  }
  if (is_variadic) text += parameters.empty() ? "..." : ", ...";
  return text + ')';
}

namespace {

double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : x == 0 ? 0 : x; }

template <double (*function)(double)>
Value unary(const BuiltinCall& call) {
  return function(call.number(0));
}

template <double (*function)(double, double)>
Value binary(const BuiltinCall& call) {
  return function(call.number(0), call.number(1));
}

double absolute(double x) { return std::abs(x); }
double floor_of(double x) { return std::floor(x); }
double ceil_of(double x) { return std::ceil(x); }
double round_of(double x) { return std::round(x); }
double ln(double x) { return math::log(x); }
double exponential(double x) { return math::exp(x); }
double root(double x) { return std::sqrt(x); }
double power(double x, double y) { return math::pow(x, y); }

// log(x) has base 10; log(base, x) has any base.
Value logarithm(const BuiltinCall& call) {
  if (call.size() == 1) return math::log10(call.number(0));
  return math::log(call.number(1)) / math::log(call.number(0));
}

Value clamp(const BuiltinCall& call) { return std::min(std::max(call.number(1), call.number(0)), call.number(2)); }

// Returns the extreme of several numbers, or of one list of numbers.
template <bool is_max>
Value extreme(const BuiltinCall& call) {
  const bool is_list = call.size() == 1 && call[0].list();
  const std::vector<Value>& values = is_list ? call.list(0).items : call.all();
  if (values.empty()) call.expected(0, "at least one number");
  call.meter.spend(values.size());
  double best = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    const double* number = values[i].number();
    if (!number) call.expected(is_list ? 0 : i, is_list ? "a list of numbers" : "numbers, or one list of numbers");
    if (i == 0 || (is_max ? *number > best : *number < best)) best = *number;
  }
  return best;
}

Value norm(const BuiltinCall& call) {
  const List& list = call.list(0);
  if (!is_number_list(list)) call.expected(0, "a list of numbers");
  call.meter.spend(list.items.size());
  double sum = 0;
  for (const Value& item : list.items) sum += *item.number() * *item.number();
  return std::sqrt(sum);
}

Value cross(const BuiltinCall& call) {
  const List &a = call.list(0), &b = call.list(1);
  const size_t size = a.items.size();
  if ((size != 2 && size != 3) || !is_number_list(a)) call.expected(0, "two lists of 2 or of 3 numbers");
  if (b.items.size() != size || !is_number_list(b))
    call.expected(1, "two lists of " + std::to_string(size) + " numbers");
  const auto minor = [&](size_t i, size_t j) {
    return *a.items[i].number() * *b.items[j].number() - *a.items[j].number() * *b.items[i].number();
  };
  if (size == 2) return minor(0, 1);
  ListBuilder result(call.meter);
  result.push(minor(1, 2));
  result.push(minor(2, 0));
  result.push(minor(0, 1));
  return result.finish();
}

// The SplitMix64 generator, which is small and gives the same numbers everywhere.
class Random {
 public:
  explicit Random(uint64_t seed) : state_(seed) {}
  double next() {
    uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_;
};

// Without a seed the seed is 0, so that a design always gives the same part.
Value rands(const BuiltinCall& call) {
  const double low = call.number(0), high = call.number(1), count = call.number(2);
  if (!std::isfinite(low) || !std::isfinite(high)) call.expected(0, "finite bounds");
  if (!(count >= 0)) call.expected(2, "a count of 0 or more");
  if (count > static_cast<double>(call.meter.limits().elements)) call.meter.too_many_elements();
  const double seed = call.has(3) ? call.number(3) : 0;
  if (!(std::abs(seed) < 0x1p53)) call.expected(3, "a finite seed");
  Random random(static_cast<uint64_t>(static_cast<int64_t>(std::floor(seed))));
  ListBuilder result(call.meter);
  const auto size = static_cast<size_t>(count);
  call.meter.spend(size);
  for (size_t i = 0; i < size; ++i) result.push(low + (high - low) * random.next());
  return result.finish();
}

Value is_undef(const BuiltinCall& call) { return call[0].is_undef(); }
Value is_bool(const BuiltinCall& call) { return call[0].boolean() != nullptr; }
Value is_num(const BuiltinCall& call) { return call[0].number() && !std::isnan(*call[0].number()); }
Value is_string(const BuiltinCall& call) { return call[0].text() != nullptr; }
Value is_list(const BuiltinCall& call) { return call[0].list() != nullptr; }
Value is_function(const BuiltinCall& call) { return call[0].closure() != nullptr; }

// Returns the version of the language, as OpenSCAD counts it.
Value version(const BuiltinCall& call) {
  ListBuilder result(call.meter);
  for (const double part : {2021.0, 1.0, 0.0}) result.push(part);
  return result.finish();
}

Value version_num(const BuiltinCall&) { return 20210100.0; }

}  // namespace

std::span<const Builtin> math_builtins() {
  static const std::vector<Builtin> table = {
      {"abs", {"x"}, 1, false, unary<absolute>},
      {"sign", {"x"}, 1, false, unary<sign_of>},
      {"sin", {"degrees"}, 1, false, unary<degrees::sine>},
      {"cos", {"degrees"}, 1, false, unary<degrees::cosine>},
      {"tan", {"degrees"}, 1, false, unary<degrees::tangent>},
      {"asin", {"x"}, 1, false, unary<degrees::arc_sine>},
      {"acos", {"x"}, 1, false, unary<degrees::arc_cosine>},
      {"atan", {"x"}, 1, false, unary<degrees::arc_tangent>},
      {"atan2", {"y", "x"}, 2, false, binary<degrees::arc_tangent2>},
      {"floor", {"x"}, 1, false, unary<floor_of>},
      {"ceil", {"x"}, 1, false, unary<ceil_of>},
      {"round", {"x"}, 1, false, unary<round_of>},
      {"ln", {"x"}, 1, false, unary<ln>},
      {"log", {"x", "of"}, 1, false, logarithm},
      {"exp", {"x"}, 1, false, unary<exponential>},
      {"pow", {"base", "exponent"}, 2, false, binary<power>},
      {"sqrt", {"x"}, 1, false, unary<root>},
      {"min", {"x"}, 1, true, extreme<false>},
      {"max", {"x"}, 1, true, extreme<true>},
      {"clamp", {"low", "x", "high"}, 3, false, clamp},
      {"norm", {"vector"}, 1, false, norm},
      {"cross", {"a", "b"}, 2, false, cross},
      {"rands", {"min", "max", "count", "seed"}, 3, false, rands},
      {"is_undef", {"value"}, 1, false, is_undef},
      {"is_bool", {"value"}, 1, false, is_bool},
      {"is_num", {"value"}, 1, false, is_num},
      {"is_string", {"value"}, 1, false, is_string},
      {"is_list", {"value"}, 1, false, is_list},
      {"is_function", {"value"}, 1, false, is_function},
      {"version", {}, 0, false, version},
      {"version_num", {}, 0, false, version_num},
  };
  return table;
}

}  // namespace ombre::lang
