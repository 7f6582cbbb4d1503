// The results of lowering nodes: fields, compositions, and what is known of them.
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

// Volume fractions at a point. They sum to one; a material that is not listed has fraction 0.
struct Composition {
  std::vector<std::pair<MaterialId, Field>> fractions;  // in ascending order of ids
  // Pairs of the number of one of Lowering's checks and a field that is 1 where the composition violates it.
  std::vector<std::pair<uint32_t, Field>> checks;

  static Composition pure(MaterialId material, Field one) { return {{{material, one}}, {}}; }
};

// The points at which a value is used. Outside a solid its composition matters only if a node above it, such as a blend
// or a complement, adds these points to the inside.
enum class Demand : uint8_t { inside, everywhere };

// The influence of solids beyond their surfaces, for smooth blends.
struct Falloff {
  std::function<Field(Field distance, const Point& p)> weight;  // 0 for distances of reach_mm or more
  double reach_mm = 0;
};

// Says whether a solid includes its surface: a point belongs to the solid if its distance is at most 0, or else if it
// is below 0.
enum class Border : uint8_t { included, excluded };
inline Border other(Border border) { return border == Border::included ? Border::excluded : Border::included; }
// Returns a <= b if the border is included, else a < b.
inline Field at_most(Field a, Field b, Border border) {
  return border == Border::included ? less_equal(a, b) : less(a, b);
}
inline Field at_most(Field a, double b, Border border) { return border == Border::included ? a <= b : a < b; }

// Values that parts are asked for, besides "inside".
enum class PartQuery : uint8_t {
  interior,  // whether the point is inside and not on the surface; nothing else
  mix,       // sums of composition over the parts that hold the point, and their number
  first,     // composition of the first part that holds the point
  last,
  along,  // position along the first part that holds the point
};

// Fields of a set of parts at a point.
struct PartFields {
  Field inside;             // or the interior, for that query
  Field count;              // number of parts that hold the point; for mix
  Composition composition;  // sums of fractions, valid where their checks are 0; for mix
  Field along;
  Field weight;                    // sum of the weights; with a falloff
  Composition weighed;             // sums of weighted fractions; with a falloff
  std::vector<size_t> others;      // numbers of inputs that are not among the parts
  std::optional<MaterialId> only;  // set if all parts consist of this material and no check can fail
};

// The quality of a solid's distance function g: an exact distance; a bound that changes at most `lipschitz` times as
// fast as the point moves; or a function of which only the sign is meaningful.
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

// The type of a value. A vector has three numbers. A colour has red, green, blue and alpha from 0 to 1, in sRGB. A
// label is the position of a name in a list, counted from 1; 0 stands for none.
enum class ValueType : uint8_t { number, vector, colour, mixture, label };
std::string_view name(ValueType type);

// The rule that combines an attribute's values where solids overlap, number by number. Between blended solids, `mix`
// weights them by their influence; elsewhere it is the mean.
enum class Overlap : uint8_t { first, last, mean, min, max, sum, mix };
inline constexpr std::array<std::string_view, 7> overlap_names{"first", "last", "mean", "min", "max", "sum", "mix"};
Overlap overlap_called(std::string_view name);  // `name` must be one of overlap_names

struct AttributeDeclaration {
  std::string name, unit;
  double default_value = 0;  // value where no solid sets it
  Overlap overlap = Overlap::first;
  ValueType type = ValueType::number;
  std::array<double, 4> default_numbers{};  // defaults of vectors and colours
  std::vector<std::string> materials = {};  // materials that a mixture may contain, in order of their ids
  std::vector<std::string> labels = {};     // names of a label
  Interval range = Interval::everything();  // range in which its numbers should lie
  bool operator==(const AttributeDeclaration&) const = default;
};

// Returns the names of an attribute's numbers, by which it is evaluated. A number or label has the attribute's own
// name; other types have several: "fibre.x", "color_rgba.r", "tissue.red". Names of attributes have no dots.
std::vector<std::string> parts_of(const AttributeDeclaration& declaration);
// Returns the attribute's name: "fibre" for "fibre.x".
std::string_view attribute_of_part(std::string_view part);
// Returns the default of one of an attribute's numbers.
double default_of(const AttributeDeclaration& declaration, std::string_view part);

}  // namespace ombre::design
