#include "load/turned.h"

#include "load/node_registry.h"

namespace ombre::compile {
namespace {

Box box_around(const Box& box, Vec3 degrees) {
  Affine turn;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 direction;
    direction[axis] = 1;
    turn = Affine::rotation(direction, degrees[axis]) * turn;
  }
  Box around;
  for (int corner = 0; corner < 8; ++corner) {
    const auto end = [&](int axis) { return (corner >> axis & 1) != 0 ? box.hi[axis] : box.lo[axis]; };
    const Vec3 place = turn({end(0), end(1), end(2)});
    around = hull(around, Box{place, place});
  }
  return around;
}

}  // namespace

LoadedPtr turned(const LoadedPtr& loaded, Vec3 degrees, Diagnostics& diagnostics) {
  if (degrees == Vec3{}) return loaded;
  const design::NodeType& type = *node_registry().find("rotate");
  const auto parameter = [&](const char* name) { return &type.parameters[static_cast<size_t>(type.parameter(name))]; };
  const Data angles(DataList{degrees.x, degrees.y, degrees.z});
  auto made = std::make_shared<Loaded>(*loaded);
  for (design::Part& part : made->design.parts) {
    const design::Reader reader{made->design.materials, diagnostics, nullptr, part.solid->where(), "rotate", ""};
    part.solid = design::make_node(type, {{parameter("angles"), angles}, {parameter("order"), Data("xyz")}},
                                   {part.solid}, reader);
    if (!part.solid) return nullptr;
  }
  if (auto& sampling = made->design.sampling) sampling->box = box_around(sampling->box, degrees);
  if (!design::check_design(made->design, diagnostics)) return nullptr;
  return made;
}

}  // namespace ombre::compile
