// Transforms, colours, names of parts and materials.
#include <algorithm>
#include <cstdio>

#include "base/math/degrees.h"
#include "lang/openscad/colours.h"
#include "lang/openscad/script_evaluator.h"
#include "lang/openscad/value_text.h"
#include "lang/openscad/vectors.h"

namespace ombre::lang::openscad {
namespace {

using solids::TreePtr;

TreePtr transformed(ModuleCall& call, const Affine& map) { return call.with_children(solids::Transform{map}); }

TreePtr translate(ModuleCall& call) {
  auto by = vector3(call["v"], 0);
  if (by && !(std::isfinite(by->x) && std::isfinite(by->y) && std::isfinite(by->z))) by = std::nullopt;
  if (!by && !is_wrong_pair(call["v"]))
    call.warn("Unable to convert translate(" + call.shown("v") + ") parameter to a vec3 or vec2 of numbers");
  return transformed(call, Affine::translation(by.value_or(Vec3{})));
}

TreePtr scale(ModuleCall& call) {
  Vec3 factors{1, 1, 1};
  if (const auto all = call.number("v"))
    factors = {*all, *all, *all};
  else if (const auto each = vector3(call["v"], 1))
    factors = *each;
  else if (!set_parts(call["v"], factors) && !is_wrong_pair(call["v"]))
    call.warn("Unable to convert scale(" + call.shown("v") +
              ") parameter to a number, a vec3 or vec2 of numbers or a number");
  return transformed(call, Affine::scaling(factors));
}

TreePtr mirror(ModuleCall& call) {
  Vec3 normal{1, 0, 0};
  if (const auto given = vector3(call["v"], 0))
    normal = *given;
  else if (!is_wrong_pair(call["v"]))
    call.warn("Unable to convert mirror(" + call.shown("v") + ") parameter to a vec3 or vec2 of numbers");
  const double size = dot(normal, normal);
  if (!(size > 0) || !std::isfinite(size)) return transformed(call, {});
  Affine map;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      map.rows[static_cast<size_t>(row)][column] =
          (row == column ? 1.0 : 0.0) - 2 * normal[row] * normal[column] / size;
  return transformed(call, map);
}

// Rounds to an integer if the difference is within rounding errors, which turns near zeros and ones into exact ones.
double tidy(double entry) {
  constexpr double rounding = 4e-16;
  const double nearest = std::round(entry);
  return std::abs(entry - nearest) < rounding ? nearest : entry;
}

// Returns a rotation about x, then y, then z, by degrees.
Affine turned(Vec3 by) {
  const double sx = degrees::sine(by.x), cx = degrees::cosine(by.x), sy = degrees::sine(by.y),
               cy = degrees::cosine(by.y), sz = degrees::sine(by.z), cz = degrees::cosine(by.z);
  Affine map;
  map.rows = {Vec3{cy * cz, cz * sx * sy - cx * sz, cx * cz * sy + sx * sz},
              Vec3{cy * sz, cx * cz + sx * sy * sz, -cz * sx + cx * sy * sz}, Vec3{-sy, cy * sx, cx * cy}};
  return map;
}

// Uses Rodrigues' formula.
Affine turned_about(Vec3 axis, double angle) {
  const double size = length(axis);
  if (!(size > 0) || !std::isfinite(size) || !std::isfinite(angle)) return {};
  const Vec3 u = (1 / size) * axis;
  const double s = degrees::sine(angle), c = degrees::cosine(angle), t = 1 - c;
  Affine map;
  map.rows = {Vec3{tidy(t * u.x * u.x + c), tidy(t * u.x * u.y - s * u.z), tidy(t * u.x * u.z + s * u.y)},
              Vec3{tidy(t * u.x * u.y + s * u.z), tidy(t * u.y * u.y + c), tidy(t * u.y * u.z - s * u.x)},
              Vec3{tidy(t * u.x * u.z - s * u.y), tidy(t * u.y * u.z + s * u.x), tidy(t * u.z * u.z + c)}};
  return map;
}

// Returns the rotation for a vector of angles. An angle that is not a number counts as 0, with a warning.
Affine turned_by_vector(const ModuleCall& call) {
  const std::vector<Value>& items = call["a"].list()->items;
  Vec3 by;
  bool is_good = items.size() <= 3;
  for (size_t i = 0; i < std::min<size_t>(3, items.size()); ++i) {
    const double* angle = items[i].number();
    is_good &= angle && std::isfinite(*angle);
    if (angle) by[static_cast<int>(i)] = std::isfinite(*angle) ? *angle : std::nan("");
  }
  if (call.has("v"))
    call.warn("When parameter a is supplied as vector, v is ignored rotate(a=" + call.shown("a") +
              ", v=" + call.shown("v") + ")");
  else if (!is_good)
    call.warn("Problem converting rotate(a=" + call.shown("a") + ") parameter");
  return turned(by);
}

TreePtr rotate(ModuleCall& call) {
  if (call["a"].list()) return transformed(call, turned_by_vector(call));
  const auto angle = call.number("a");
  const bool is_good = angle && std::isfinite(*angle);
  if (!is_good) call.warn("Problem converting rotate(a=" + call.shown("a") + ") parameter");
  Vec3 axis{0, 0, 1};
  if (const auto given = vector3(call["v"], 0))
    axis = *given;
  else if (call.has("v") && !set_parts(call["v"], axis) && is_good)
    call.warn("Problem converting rotate(..., v=" + call.shown("v") + ") parameter");
  return transformed(call, turned_about(axis, is_good ? *angle : 0));
}

TreePtr multmatrix(ModuleCall& call) {
  Affine map;
  double last = 1;
  const List* rows = call["m"].list();
  for (size_t row = 0; rows && row < std::min<size_t>(4, rows->items.size()); ++row) {
    const List* line = rows->items[row].list();
    for (size_t column = 0; line && column < std::min<size_t>(4, line->items.size()); ++column) {
      const double* entry = line->items[column].number();
      if (!entry) continue;
      if (row == 3 && column == 3) last = *entry;
      if (row == 3) continue;
      if (column == 3)
        map.offset[static_cast<int>(row)] = *entry;
      else
        map.rows[row][static_cast<int>(column)] = *entry;
    }
  }
  if (last != 1 && last != 0)
    for (size_t row = 0; row < 3; ++row) {
      map.rows[row] = (1 / last) * map.rows[row];
      map.offset[static_cast<int>(row)] /= last;
    }
  return transformed(call, map);
}

TreePtr color(ModuleCall& call) {
  solids::SetColour result{{-1, -1, -1, 1}};
  const Value& value = call["c"];
  if (const List* list = value.list()) {
    result.colour = {1, 1, 1, 1};
    for (size_t i = 0; i < std::min<size_t>(4, list->items.size()); ++i) {
      const double part = list->items[i].number() ? *list->items[i].number() : 0;
      result.colour[i] = part;
      if (part >= 0 && part <= 1) continue;
      std::array<char, 64> shown;
      std::snprintf(shown.data(), shown.size(), "%.1f", part);
      call.warn(std::string("color() expects numbers between 0.0 and 1.0. Value of ") + shown.data() +
                " is out of range");
    }
  } else if (const Text* name = value.text()) {
    if (const auto colour = colour_of(name->text)) {
      result.colour = *colour;
    } else {
      call.warn("Unable to parse color \"" + to_lower(name->text) + '"');
      call.note("Please see https://en.wikipedia.org/wiki/Web_colors");
    }
  }
  if (const auto opacity = call.number("alpha")) result.colour[3] = *opacity;
  return call.with_children(result);
}

// Returns the name, which must be a non-empty string or a number.
std::string given_name(ModuleCall& call) {
  const Value& name = call["name"];
  if (name.number()) return number_text(*name.number());
  if (!name.text() || name.text()->text.empty())
    call.warn(call.name() + "() needs a name: " + call.name() + "(\"body\")");
  return name.text() ? name.text()->text : "";
}

TreePtr part(ModuleCall& call) {
  std::string name = given_name(call);
  return call.with_children(solids::SetPart{std::move(name)});
}

TreePtr material(ModuleCall& call) {
  std::string name = given_name(call);
  return call.with_children(solids::SetMaterial{std::move(name)});
}

}  // namespace

std::vector<Module> transform_modules() {
  return {{"translate", {"v"}, {}, translate},   {"rotate", {"a", "v"}, {}, rotate},
          {"scale", {"v"}, {}, scale},           {"mirror", {"v"}, {}, mirror},
          {"multmatrix", {"m"}, {}, multmatrix}, {"color", {"c", "alpha"}, {}, color},
          {"part", {"name"}, {}, part},          {"material", {"name"}, {}, material}};
}

}  // namespace ombre::lang::openscad
