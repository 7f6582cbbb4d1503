// What nodes lower to.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/math/interval.h"
#include "base/math/run.h"
#include "program/field.h"

namespace ombre::design {

using program::Field;
using program::Point;

// Volume fractions at a point. They sum to one; a material that is not listed has none.
struct Composition {
  std::vector<std::pair<MaterialId, Field>> fractions;  // ascending ids
  // Fields that are 1 where something is wrong with the composition; numbers of Lowering's checks.
  std::vector<std::pair<uint32_t, Field>> checks;

  static Composition pure(MaterialId material, Field one) { return {{{material, one}}, {}}; }
};

// Where a value will be used. Outside of a solid its composition matters only if something above
// (a blend, a complement) makes points inside that were outside.
enum class Demand : uint8_t { inside, everywhere };

// The influence of solids beyond their surfaces, by which they are joined smoothly.
struct Falloff {
  std::function<Field(Field distance, const Point& p)> weight;  // 0 from reach_mm on
  double reach_mm = 0;
};

// Whether a solid's surface belongs to it: then a point is a member where the distance is at most 0, else below 0.
enum class Border : uint8_t { included, excluded };
inline Border other(Border border) { return border == Border::included ? Border::excluded : Border::included; }
// a <= b with the border, a < b without.
inline Field at_most(Field a, Field b, Border border) {
  return border == Border::included ? less_equal(a, b) : less(a, b);
}
inline Field at_most(Field a, double b, Border border) { return border == Border::included ? a <= b : a < b; }

// Outputs of the parts besides "inside".
enum class PartQuery : uint8_t {
  interior,  // only whether a point is inside and not on the surface; nothing else
  mix,       // of the composition: sums over the parts that hold the point, and their number
  first,     // the composition of the first part that holds the point
  last,
  along,  // the place along the first part that holds the point
};

// Parts at a point, as fields.
struct PartFields {
  Field inside;             // or interior
  Field count;              // of mix: how many hold the point
  Composition composition;  // of mix: sums of fractions; checks where they are 1
  Field along;
  Field weight;                    // with a falloff: the sum of the weights
  Composition weighed;             // the same, with fractions times weights
  std::vector<size_t> others;      // inputs that are not among the parts
  std::optional<MaterialId> only;  // all parts are of this one material, and nothing can be wrong
};

// What is known of a solid's g: an exact distance; a bound of it that changes at most `lipschitz` times
// as fast as the point moves; or a value of which only the sign is meant.
struct Metric {
  enum class Kind : uint8_t { exact, bounded, implicit };
  Kind kind = Kind::exact;
  double lipschitz = 1;

  static Metric exact() { return {}; }
  static Metric bounded(double lipschitz = 1) { return {Kind::bounded, lipschitz}; }
  static Metric implicit() { return {Kind::implicit, 0}; }
  bool is_implicit() const { return kind == Kind::implicit; }
  bool operator==(const Metric&) const = default;
};

inline Metric weaker(Metric a, Metric b) {
  if (a.is_implicit() || b.is_implicit()) return Metric::implicit();
  return {std::max(a.kind, b.kind), std::max(a.lipschitz, b.lipschitz)};
}

inline std::string_view name(Metric::Kind kind) {
  return kind == Metric::Kind::exact ? "exact" : kind == Metric::Kind::bounded ? "bounded" : "implicit";
}

// A value has one of these types. A vector has three numbers; a colour has red, green, blue and alpha from 0 to 1, in
// sRGB. A label is one of several names: its number is the name's place in their list, from 1 on; 0 is none of them.
enum class ValueType : uint8_t { number, vector, colour, mixture, label };
std::string_view name(ValueType type);

// How an attribute's values combine where solids overlap, number by number. Between solids that are blended, `mix`
// weighs them by their influence; elsewhere it is the mean.
enum class Overlap : uint8_t { first, last, mean, min, max, sum, mix };
inline constexpr std::array<std::string_view, 7> overlap_names{"first", "last", "mean", "min", "max", "sum", "mix"};
Overlap overlap_called(std::string_view name);  // which is one of the names

struct AttributeDeclaration {
  std::string name, unit;
  double default_value = 0;  // where no solid gives one
  Overlap overlap = Overlap::first;
  ValueType type = ValueType::number;
  std::array<double, 4> default_numbers{};  // of vectors and colours
  std::vector<std::string> materials = {};  // of a mixture: those that it may hold, in the order of their ids
  std::vector<std::string> labels = {};     // of a label: the names
  Interval range = Interval::everything();  // that its numbers are meant to lie in
  bool operator==(const AttributeDeclaration&) const = default;
};

// An attribute is asked for number by number. These are the names of its numbers: of a number or label its own, of
// others "fibre.x", "color_rgba.r", "tissue.red". Names of attributes have no dots.
std::vector<std::string> parts_of(const AttributeDeclaration& declaration);
// "fibre" of "fibre.x".
std::string_view attribute_of_part(std::string_view part);
// Returns the default of one of an attribute's numbers.
double default_of(const AttributeDeclaration& declaration, std::string_view part);

}  // namespace ombre::design
