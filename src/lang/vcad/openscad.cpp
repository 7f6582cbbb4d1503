#include "lang/vcad/openscad.h"

namespace ombre::lang {
namespace {

struct ModuleHint {
  std::string_view module, hint;
};

constexpr ModuleHint modules[] = {
    {"color", "write material(\"red\") { ... }, or name the material in the solid: sphere(5, \"red\")"},
    {"linear_extrude", "write polygon_extrude([[0, 0], [20, 0], [0, 10]], 5)"},
    {"rotate_extrude", "write revolve([[2, 0], [5, 0], [5, 10]])"},
    {"square", "there are solids only; write rectprism((20, 10, 5))"},
    {"circle", "there are solids only; write cylinder(5, 10), of a radius and a height"},
    {"polygon", "there are solids only; write polygon_extrude([[0, 0], [20, 0], [0, 10]], 5)"},
    {"polyhedron", "write hull([[0, 0, 0], [10, 0, 0], [0, 10, 0], [0, 0, 10]]), or mesh(\"part.stl\") for a file"},
    {"import", "write mesh(\"part.stl\")"},
    {"surface", "write relief(\"picture.png\")"},
    {"multmatrix", "write matrix([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { ... }"},
    {"minkowski", "write offset(1) { ... } to round a solid by a ball of 1 mm"},
    {"resize", "write scale([2, 1, 1]) { ... }"},
    {"intersection_for", "write intersection() { for (...) ... }"},
    {"render", "leave it out; nothing has to be rendered beforehand"},
    {"projection", "outlines are made by the command ombre contours"},
};

struct ArgumentHint {
  std::string_view node, argument, hint;
};

constexpr std::string_view centred = "it is centred; translate moves it";

constexpr ArgumentHint arguments[] = {
    {"cube", "center", centred},
    {"cylinder", "center", centred},
    {"sphere", "d", "write the radius, half as much"},
    {"cylinder", "d", "write r, half as much"},
    {"cylinder", "r1", "write cone(r1=5, r2=2, h=10)"},
    {"cylinder", "r2", "write cone(r1=5, r2=2, h=10)"},
    {"rotate", "a", "write rotate(axis=[0, 0, 1], deg=45)"},
    {"rotate", "v", "write rotate(axis=[0, 0, 1], deg=45)"},
};

}  // namespace

std::string openscad_module_hint(std::string_view name) {
  for (const ModuleHint& known : modules)
    if (known.module == name) return std::string(known.hint);
  return "";
}

std::string openscad_argument_hint(const design::NodeType& type, std::string_view name) {
  for (const ArgumentHint& known : arguments)
    if (known.node == type.name && known.argument == name) return std::string(known.hint);
  return "";
}

bool is_block_of_openscad(std::string_view node, std::string_view parameter, const Data& value) {
  return node == "cube" && parameter == "side" && value.list();
}

}  // namespace ombre::lang
