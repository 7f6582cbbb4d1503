// Solids for tests, made from JSON text and evaluated at points.
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "base/text/json.h"
#include "design/design.h"
#include "design/lowering.h"
#include "nodes/all_nodes.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"

namespace ombre::nodes {

inline const design::MaterialTable& two_materials() {
  static const design::MaterialTable table = [] {
    Diagnostics diagnostics;
    const auto data = parse_json(make_source("materials", R"({"materials": [
        {"name": "red", "r": 255, "g": 0, "b": 0}, {"name": "blue", "r": 0, "g": 0, "b": 255}]})"),
                                 diagnostics);
    return *design::MaterialTable::read(*data, diagnostics);
  }();
  return table;
}

class Solid {
 public:
  // Makes a node. The test fails if that is not possible.
  static design::NodePtr node(const std::string& type, const std::string& parameters,
                              std::vector<design::NodePtr> inputs = {}) {
    Diagnostics diagnostics;
    const auto data = parse_json(make_source("parameters", parameters), diagnostics);
    const design::NodeType& node_type = *registry().find(type);
    std::vector<design::NamedValue> values;
    for (const auto& [name, value] : *data->members())
      values.push_back({&node_type.parameters[static_cast<size_t>(node_type.parameter(name))], value});
    auto made = make_node(node_type, values, std::move(inputs), {two_materials(), diagnostics, nullptr, {}, "", ""});
    EXPECT_TRUE(made) << to_text(diagnostics);
    return made;
  }

  explicit Solid(design::NodePtr made) : node_(std::move(made)) {
    design::LoweringContext context(two_materials(), {node_});
    program::Builder builder;
    design::Lowering lowering(context, builder);
    const program::Point p = program::Point::origin_frame(builder);
    program::Outputs outputs{{"inside", lowering.inside(*node_, p)},
                             {"distance", lowering.distance(*node_, p)},
                             {"red", builder.constant(0)},
                             {"t", lowering.output(*node_, design::along_output, p)[0]}};
    for (const auto& [id, fraction] : lowering.composition(*node_, p, design::Demand::inside).fractions)
      if (id == 1) outputs[2].second = fraction;
    context.finish_bodies();
    const program::Program whole = program::inline_bodies(builder.finish(outputs));
    std::vector<Interval> ranges;
    evaluate_intervals(whole, Box::centered({1e4, 1e4, 1e4}), ranges);
    program_ = program::expand_parts(whole, ranges, program::Precision::reference);
  }

  bool inside(Vec3 p) const { return at(p, 0) == 1; }
  double distance(Vec3 p) const { return at(p, 1); }
  double red(Vec3 p) const { return at(p, 2); }  // fraction of the first material
  double along(Vec3 p) const { return at(p, 3); }

  // Returns the share of the box that is inside, sampled at the centres of n x n x n cells.
  double share(const Box& box, int n) const {
    int count = 0;
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const Vec3 f{(i + 0.5) / n, (j + 0.5) / n, (k + 0.5) / n}, s = box.size();
          count += inside(box.lo + Vec3{f.x * s.x, f.y * s.y, f.z * s.z}) ? 1 : 0;
        }
    return count / (static_cast<double>(n) * n * n);
  }

 private:
  double at(Vec3 p, size_t output) const {
    std::vector<double> values;
    evaluate_point(program_, p, values);
    return values[program_.outputs[output]];
  }

  design::NodePtr node_;
  program::Program program_;
};

}  // namespace ombre::nodes
