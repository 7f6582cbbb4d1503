// Makes the nodes by which properties are resolved.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/math/math.h"
#include "calibration/piecewise.h"
#include "design/design.h"
#include "design/outputs.h"
#include "load/node_registry.h"

namespace ombre::compile {

// Makes nodes above a solid. `loader`, which may be null, reads files.
class NodeMaker {
 public:
  NodeMaker(const design::Design& design, const SourceRange& where, Diagnostics& diagnostics,
            design::SourceLoader* loader = nullptr)
      : design_(design), where_(where), diagnostics_(diagnostics), loader_(loader) {}

  using Parameters = std::vector<std::pair<const char*, Data>>;
  // Returns null, and adds diagnostics, if the node cannot be made.
  design::NodePtr make(const char* name, const Parameters& parameters, std::vector<design::NodePtr> inputs = {}) const {
    const design::NodeType& type = *node_registry().find(name);
    std::vector<design::NamedValue> values;
    for (const auto& [parameter, data] : parameters)
      values.push_back({&type.parameters[static_cast<size_t>(type.parameter(parameter))], data});
    return design::make_node(type, values, std::move(inputs), reader(name));
  }
  design::Reader reader(const char* node) const { return {design_.materials, diagnostics_, loader_, where_, node, ""}; }

  // Returns an attribute of the solid, or one of its numbers such as "color_rgb.x".
  expr::Expression attribute_of(const design::NodePtr& solid, const std::string& name) const {
    return first_output(make("attribute_of", {{"solid", node_data(solid)}, {"name", Data(name)}}));
  }

  // Returns the curve of the solid's attribute.
  expr::Expression curve_of(const design::NodePtr& solid, const std::string& attribute,
                            const calibration::Piecewise& curve) const {
    expr::Expression key = attribute_of(solid, attribute);
    if (curve.of_logarithm) {  // what is not positive has no logarithm; it gets that of the least value
      const auto least = expr::Expression::constant(math::exp(curve.points.front().first));
      key = expr::Expression::call("log", {expr::Expression::call("max", {key, least})});
    }
    DataList rows;
    for (const auto& [at, result] : curve.points) rows.emplace_back(DataList{at, result});
    return first_output(make("table", {{"rows", Data(std::move(rows))}, {"a", formula_data(key)}}));
  }

  static Data node_data(const design::NodePtr& node) { return Data(std::make_shared<design::NodeObject>(node)); }
  static Data formula_data(const expr::Expression& formula) {
    return Data(std::make_shared<design::FormulaObject>(formula));
  }
  static expr::Expression first_output(const design::NodePtr& node) {
    return design::expression_of({node, node->first_output()});
  }

 private:
  const design::Design& design_;
  SourceRange where_;
  Diagnostics& diagnostics_;
  design::SourceLoader* loader_;
};

}  // namespace ombre::compile
