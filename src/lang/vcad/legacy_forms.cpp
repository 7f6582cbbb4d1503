#include "lang/vcad/legacy_forms.h"

#include <algorithm>

#include "base/text/text.h"
#include "design/outputs.h"

namespace ombre::lang {
namespace {

struct Alias {
  std::string_view node, spelling, parameter;
};

constexpr Alias aliases[] = {
    {"sphere", "r", "radius"},
    {"cylinder", "r", "radius"},
    {"cylinder", "h", "height"},
    {"cube", "s", "side"},
    {"cube", "size", "side"},
    {"rectprism", "s", "size"},
    {"cone", "r1", "base"},
    {"cone", "r2", "top"},
    {"cone", "h", "height"},
    {"strut", "r", "radius"},
    {"rotate", "deg", "degrees"},
    {"fgrade", "func", "functions"},
    {"fgrade", "function", "functions"},
    {"fgrade", "probabilities", "functions"},
    {"function", "func", "expression"},
    {"function", "expr", "expression"},
    {"mesh", "file", "path"},
    {"sum", "b", "blend"},
    {"ellipsoid", "r", "radii"},
    {"polygon_extrude", "points", "vertices"},
    {"revolve", "points", "profile"},
    {"tube", "r", "radius"},
    {"text", "size", "height"},
    {"voxel", "size", "voxel"},
};

constexpr std::string_view vector_nodes[] = {"rectprism", "ellipsoid",  "translate", "scale",   "mirror",
                                             "rotate",    "half_space", "blend",     "majority"};

bool is_number(const Data& data) { return data.number() || (design::is_value(data) && !design::is_mixture(data)); }
bool is_number_like(const Data& data) { return is_number(data) || data.string(); }

// Returns the parameter that three leading numbers stand for.
std::string first_parameter(const design::NodeType& type) { return type.parameters[0].name; }

size_t positional_count(const std::vector<Argument>& arguments) {
  size_t count = 0;
  while (count < arguments.size() && arguments[count].name.empty()) ++count;
  return count;
}

Argument vector_argument(const std::string& name, const Argument& a, const Argument& b, const Argument& c) {
  SourceRange where = a.value.where;
  where.end = std::max(where.end, c.value.where.end);
  return {name, {}, Data(DataList{a.value, b.value, c.value}, where)};
}

// Joins three leading numbers to one vector: translate(1, 2, 3), rectprism(1, 2, 3, "red"), rotate(0, 0, 90).
void gather_leading_numbers(const design::NodeType& type, std::vector<Argument>& arguments) {
  if (std::find(std::begin(vector_nodes), std::end(vector_nodes), type.name) == std::end(vector_nodes)) return;
  if (positional_count(arguments) < 3) return;
  if (!is_number(arguments[0].value) || !is_number_like(arguments[1].value) || !is_number_like(arguments[2].value))
    return;
  arguments[0] = vector_argument("", arguments[0], arguments[1], arguments[2]);
  arguments.erase(arguments.begin() + 1, arguments.begin() + 3);
}

// Joins named components to a vector: translate(x=5, z=1), rotate(pitch=30, roll=90).
void gather_named_components(const design::NodeType& type, std::vector<Argument>& arguments) {
  const bool turns = type.name == "rotate";
  if (!turns && type.name != "translate" && type.name != "scale") return;
  const std::string_view names[2][3] = {{"x", "y", "z"}, {"pitch", "yaw", "roll"}};
  const double otherwise = type.name == "scale" ? 1 : 0;
  DataList components(3, Data(otherwise));
  Argument vector;
  bool found = false;
  std::erase_if(arguments, [&](const Argument& argument) {
    for (size_t i = 0; i < 3; ++i) {
      if (argument.name != names[0][i] && !(turns && argument.name == names[1][i])) continue;
      components[i] = argument.value;
      if (!found) vector = argument;
      return found = true;
    }
    return false;
  });
  if (!found) return;
  vector.name = first_parameter(type);
  vector.value = Data(std::move(components), vector.value.where);
  arguments.push_back(std::move(vector));
}

// Names the arguments of strut(length, radius, "mat"), a strut from the origin along +x.
void spell_out_short_strut(std::vector<Argument>& arguments) {
  const size_t count = positional_count(arguments);
  if (count < 2 || !arguments[0].value.number() || !is_number_like(arguments[1].value)) return;
  const Data length = arguments[0].value;
  arguments[0].name = "end";
  arguments[0].value = Data(DataList{length, Data(0.0), Data(0.0)}, length.where);
  arguments[1].name = "radius";
  if (count > 2) arguments[2].name = "material";
}

// Names the arguments of function((min), (max), "expr", "mat").
void spell_out_bounded_function(std::vector<Argument>& arguments) {
  const size_t count = positional_count(arguments);
  if (count < 3 || !arguments[0].value.list() || !arguments[1].value.list()) return;
  const std::string_view names[] = {"min", "max", "expression", "material"};
  for (size_t i = 0; i < std::min<size_t>(4, count); ++i) arguments[i].name = names[i];
}

}  // namespace

std::string_view node_name(std::string_view spelling) {
  const std::string folded = fold_name(spelling);
  if (folded == "frep" || folded == "functiongeom") return "function";
  return spelling;
}

std::vector<Argument> modern_arguments(const design::NodeType& type, std::vector<Argument> arguments) {
  gather_leading_numbers(type, arguments);
  gather_named_components(type, arguments);
  if (type.name == "strut") spell_out_short_strut(arguments);
  if (type.name == "function") spell_out_bounded_function(arguments);
  // Replaces the number in scale(2) by a vector.
  if (type.name == "scale" && arguments.size() == 1 && arguments[0].value.number())
    arguments[0].value = Data(DataList(3, arguments[0].value), arguments[0].value.where);
  for (Argument& argument : arguments) {
    if (argument.name.empty()) continue;
    for (const Alias& alias : aliases)
      if (alias.node == type.name && alias.spelling == argument.name && type.parameter(argument.name) < 0)
        argument.name = alias.parameter;
  }
  return arguments;
}

}  // namespace ombre::lang
