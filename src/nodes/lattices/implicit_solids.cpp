// Solids given by a formula.
#include "design/spec.h"
#include "nodes/common/shapes.h"
#include "nodes/lattices/lattice_families.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Function {
  Number expression;
  MaterialName material;
  std::optional<Vec3> min, max;

  static Spec<Function> spec() {
    return {"function",
            "implicit solids",
            "All points where an expression is 0 or less.",
            {{"expression", &Function::expression, "Expression in x, y, z, rho, phic, r, theta, phis", required()},
             {"material", &Function::material, "Its material"},
             {"min", &Function::min, "Least corner of the box to which it is cut; none: its parent's box", unit::mm},
             {"max", &Function::max, "Greatest corner of that box", unit::mm}},
            no_inputs,
            "function((-8, -8, -8), (8, 8, 8), \"sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)\", \"red\");"};
  }

  bool complete(const Reader& reader) const {
    if (min.has_value() != max.has_value()) {
      reader.diagnostics.error(reader.where, "function needs both corners of its box, min and max, or none");
      return false;
    }
    if (!min || (min->x < max->x && min->y < max->y && min->z < max->z)) return true;
    reader.diagnostics.error(reader.where, "the box of function is empty: max must be greater than min on each axis");
    return false;
  }

  Metric metric() const { return Metric::implicit(); }
  Box reach(const Inputs&, const Box& where, double margin) const {
    const Box box = min ? intersect(Box{*min, *max}.expanded(margin), where) : where;
    return expression.range(box).lo > margin ? Box::empty() : box;
  }

  // Within the box, the value is that of the expression.
  Field distance(const Point& p) const {
    const Field value = expression(p);
    if (!min) return value;
    const Vec3 c = 0.5 * (*min + *max), h = 0.5 * (*max - *min);
    const Field from_box = corner(abs(p.x - c.x) - h.x, abs(p.y - c.y) - h.y, abs(p.z - c.z) - h.z);
    return select(from_box <= 0, value, program::max(value, from_box));
  }
};

}  // namespace

void add_implicit_solids(Registry& registry) { registry.add<Function>(); }

}  // namespace ombre::nodes
