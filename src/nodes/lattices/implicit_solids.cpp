// Solids given by a formula.
#include "design/spec.h"
#include "nodes/common/parameter_checks.h"
#include "nodes/common/shapes.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Function {
  Number expression;
  MaterialName material;
  std::optional<Vec3> min, max;

  static Spec<Function> spec() {
    return {"function",
            "All points where an expression is 0 or less.",
            {{"expression", &Function::expression, "Expression in x, y, z, rho, phic, r, theta, phis", required()},
             {"material", &Function::material, "Its material"},
             {"min", &Function::min, "Least corner of the box to which it is cut; none: its parent's box", unit::point},
             {"max", &Function::max, "Greatest corner of that box", unit::point}},
            no_inputs,
            "function((-8, -8, -8), (8, 8, 8), \"sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x)\", \"red\");"};
  }

  bool complete(const Reader& reader) const { return is_box_or_none(reader, min, max); }

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

void add_implicit_solids(Registry& registry) { registry.add<Function>("implicit solids"); }

}  // namespace ombre::nodes
