// Named values that solids carry besides their material.
#include "base/text.h"
#include "design/spec.h"
#include "nodes/all_nodes.h"
#include "nodes/child_distance.h"

namespace ombre::nodes {
namespace {

using namespace design;

struct Attribute {
  std::string name;
  Number value;
  std::string unit_text;
  double default_value = 0;
  Choice overlap = "first";

  static Spec<Attribute> spec() {
    return {"attribute",
            "attributes",
            "Gives its child a named value, constant or by a formula: density, infill, temperature, ...",
            {{"name", &Attribute::name, "Its name", required()},
             {"value", &Attribute::value,
              "A number, or an expression; d is the signed distance of the child, t the place along its struts",
              required(with_variables({"d", "t"}))},
             {"unit", &Attribute::unit_text, "Its unit, for whoever reads it"},
             {"default", &Attribute::default_value, "Its value where no solid gives one"},
             {"overlap", &Attribute::overlap, "How values combine where solids overlap",
              one_of({"first", "mean", "sum", "max"})}},
            one_solid,
            "attribute(\"infill\", \"0.2 + 0.02*z\", \"1\") { cube(10); }"};
  }

  bool complete(const Reader& reader, const std::vector<NodePtr>& inputs) const {
    if (!check_child_variables(reader, *inputs[0], {&value, 1})) return false;
    if (!name.empty() && fold_name(name) != "material") return true;
    reader.diagnostics.error(reader.where, name.empty() ? "an attribute needs a name"
                                                        : "the attribute \"material\" is set by fgrade or material");
    return false;
  }

  AttributeDeclaration declares() const {
    const Overlap rule = overlap == "mean"  ? Overlap::mean
                         : overlap == "sum" ? Overlap::sum
                         : overlap == "max" ? Overlap::max
                                            : Overlap::first;
    return {name, unit_text, default_value, rule};
  }

  // Attributes of other names come from the child.
  Field attribute(const Inputs& in, std::string_view wanted, const Point& p, Demand demand) const {
    if (wanted != name) return in.attribute(0, wanted, p, demand);
    return value.at(p, child_variables(in, p));
  }
};

}  // namespace

void add_attributes(Registry& registry) { registry.add<Attribute>(); }

}  // namespace ombre::nodes
