// Builtin functions of numbers.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/math/vec.h"
#include "lang/engine/builtins.h"
#include "lang/engine/common_functions.h"

namespace ombre::lang {
namespace {

double sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : x == 0 ? 0 : x; }

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
  const auto vector = [size](const List& list) {
    const double third = size == 3 ? *list.items[2].number() : 0;
    return Vec3{*list.items[0].number(), *list.items[1].number(), third};
  };
  const Vec3 normal = ombre::cross(vector(a), vector(b));
  return size == 2 ? Value(normal.z) : make_list({normal.x, normal.y, normal.z}, call.meter);
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

// Returns the version of the language, as OpenSCAD counts it.
Value version(const BuiltinCall& call) { return make_list({2021, 1, 0}, call.meter); }

Value version_num(const BuiltinCall&) { return 20210100.0; }

}  // namespace

std::vector<Builtin> math_builtins() {
  return {
      {"sign", {"x"}, 1, false, common::of_number<sign_of>},
      {"log", {"x", "of"}, 1, false, common::logarithm},
      {"min", {"x"}, 1, true, extreme<false>},
      {"max", {"x"}, 1, true, extreme<true>},
      {"clamp", {"low", "x", "high"}, 3, false, clamp},
      {"norm", {"vector"}, 1, false, norm},
      {"cross", {"a", "b"}, 2, false, cross},
      {"rands", {"min", "max", "count", "seed"}, 3, false, rands},
      {"version", {}, 0, false, version},
      {"version_num", {}, 0, false, version_num},
  };
}

}  // namespace ombre::lang
