// Solids with flat faces.
#include "design/spec.h"
#include "nodes/common/shapes.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Cube {
  Number side = 10;
  MaterialName material;

  static Spec<Cube> spec() {
    return {
        "cube",
        "A cube centred on the origin.",
        {{"side", &Cube::side, "Length of an edge", unit::positive_mm}, {"material", &Cube::material, "Its material"}},
        no_inputs,
        "cube(10, \"red\");"};
  }

  Box bounds(const Box& where) const {
    const double h = side.range(where).hi / 2;
    return Box::centered({h, h, h});
  }

  Traits traits() const { return grows_outward; }

  Field distance(const Point& p) const {
    const Field half = side(p) * 0.5;
    return corner(abs(p.x) - half, abs(p.y) - half, abs(p.z) - half);
  }
};

struct RectPrism {
  Numbers3 size{10, 10, 10};
  MaterialName material;

  static Spec<RectPrism> spec() {
    return {"rectprism",
            "A block with edges along the axes, centred on the origin.",
            {{"size", &RectPrism::size, "Lengths along x, y and z", unit::positive_mm},
             {"material", &RectPrism::material, "Its material"}},
            no_inputs,
            "rectprism((20, 10, 5), \"blue\");"};
  }

  Box bounds(const Box& where) const { return Box::centered(0.5 * size.upper(where)); }

  Traits traits() const { return grows_outward; }

  Field distance(const Point& p) const {
    return corner(abs(p.x) - size.x(p) * 0.5, abs(p.y) - size.y(p) * 0.5, abs(p.z) - size.z(p) * 0.5);
  }
};

struct HalfSpace {
  Vec3 normal{0, 0, 1};
  Number offset = 0;
  MaterialName material;

  static Spec<HalfSpace> spec() {
    return {"half_space",
            "Everything behind a plane. Use it to cut other solids.",
            {{"normal", &HalfSpace::normal, "Outward direction; any length", required(unit::direction)},
             {"offset", &HalfSpace::offset, "Distance of the plane from the origin along the normal", unit::offset},
             {"material", &HalfSpace::material, "Its material"}},
            no_inputs,
            "intersection() { sphere(8, \"red\"); half_space((0, 0, 1)); }"};
  }

  bool complete(const Reader& reader) const {
    if (length(normal) > 0) return true;
    return reader.refuse("the normal of half_space has no direction",
                         "write for example " + spelled::value("(0, 0, 1)"));
  }

  Box bounds(const Box& where) const {
    Box box = where;
    const double reach = offset.range(where).hi;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(normal[axis]) != length(normal)) continue;  // a tilted plane does not limit the box along this axis
      if (normal[axis] > 0) box.hi[axis] = std::min(box.hi[axis], reach);
      if (normal[axis] < 0) box.lo[axis] = std::max(box.lo[axis], -reach);
    }
    return box;
  }

  Field distance(const Point& p) const {
    const Vec3 n = (1 / length(normal)) * normal;
    return p.x * n.x + p.y * n.y + p.z * n.z - offset(p);
  }
};

}  // namespace

void add_box_solids(Registry& registry) { registry.add<Cube, RectPrism, HalfSpace>("box solids"); }

}  // namespace ombre::nodes
