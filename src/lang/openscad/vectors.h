// Vectors of numbers as parameters of modules.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/math/vec.h"
#include "lang/engine/value.h"

namespace ombre::lang::openscad {

// Returns the numbers of a vector with exactly `count` numbers, else nothing.
template <size_t count>
std::optional<std::array<double, count>> numbers(const Value& value) {
  const List* list = value.list();
  if (!list || list->items.size() != count) return std::nullopt;
  std::array<double, count> result{};
  for (size_t i = 0; i < count; ++i) {
    if (!list->items[i].number()) return std::nullopt;
    result[i] = *list->items[i].number();
  }
  return result;
}

// Reads a vector of two or three numbers.
inline std::optional<Vec3> vector3(const Value& value, double third) {
  if (const auto three = numbers<3>(value)) return Vec3{(*three)[0], (*three)[1], (*three)[2]};
  if (const auto two = numbers<2>(value)) return Vec3{(*two)[0], (*two)[1], third};
  return std::nullopt;
}

// Sets the components of a vector up to the first that is not a number. Returns true if all three were set.
inline bool set_parts(const Value& value, Vec3& parts) {
  const List* list = value.list();
  if (!list || list->items.size() != 3) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double* number = list->items[static_cast<size_t>(axis)].number();
    if (!number) return false;
    parts[axis] = *number;
  }
  return true;
}

// True for a vector of two elements that are not both numbers, which OpenSCAD ignores.
inline bool is_wrong_pair(const Value& value) {
  return value.list() && value.list()->items.size() == 2 && !numbers<2>(value);
}

// Converts a parameter such as `convexity` to an integer. Large values are clamped.
inline int whole(double number) {
  constexpr double most = 1e9;
  return std::isnan(number) ? 0 : static_cast<int>(std::max(-most, std::min(most, number)));
}

}  // namespace ombre::lang::openscad
