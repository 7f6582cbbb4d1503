// Helpers for tests of value nodes: making nodes by name, and evaluating outputs at points.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/text/json.h"
#include "design/attributes.h"
#include "design/design.h"
#include "design/lowering.h"
#include "nodes/all_nodes.h"
#include "nodes/test_sources.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"

namespace ombre::nodes::test {

using namespace design;

class ValueTest : public testing::Test {
 protected:
  ValueTest() {
    const auto data = parse_json(make_source("m", R"({"materials": [{"name": "red", "r": 255, "g": 0, "b": 0},
        {"name": "blue", "r": 0, "g": 0, "b": 255}, {"name": "clear", "r": 4, "g": 4, "b": 4}]})"),
                                 diagnostics_);
    materials_ = *MaterialTable::read(*data, diagnostics_);
  }

  using Named = std::vector<std::pair<std::string, Data>>;
  NodePtr try_make(const std::string& type, const Named& values, std::vector<NodePtr> inputs = {}) {
    const NodeType& t = *registry().find(type);
    std::vector<NamedValue> named;
    for (const auto& [name, data] : values) {
      EXPECT_GE(t.parameter(name), 0) << name;
      named.push_back({&t.parameters[static_cast<size_t>(t.parameter(name))], data});
    }
    return make_node(t, named, std::move(inputs), {materials_, diagnostics_, &loader_, {}, "", ""});
  }
  NodePtr make(const std::string& type, const Named& values, std::vector<NodePtr> inputs = {}) {
    NodePtr node = try_make(type, values, std::move(inputs));
    EXPECT_TRUE(node) << to_text(diagnostics_);
    return node;
  }
  std::string error_of(const std::string& type, const Named& values, std::vector<NodePtr> inputs = {}) {
    diagnostics_ = {};
    EXPECT_FALSE(try_make(type, values, std::move(inputs)));
    return to_text(diagnostics_);
  }

  static Data object(const NodePtr& node) { return Data(HostObjectPtr(std::make_shared<NodeObject>(node))); }
  static Data list(std::initializer_list<double> numbers) {
    DataList data;
    for (const double number : numbers) data.emplace_back(number);
    return Data(std::move(data));
  }
  static Data rows(std::initializer_list<std::initializer_list<double>> numbers) {
    DataList data;
    for (const auto& row : numbers) data.push_back(list(row));
    return Data(std::move(data));
  }

  // Returns the numbers of a named output at a point.
  std::vector<double> at(const NodePtr& node, const std::string& output, Vec3 p) {
    LoweringContext context(materials_, {node});
    program::Builder builder;
    Lowering lowering(context, builder);
    const Point point = Point::origin_frame(builder);
    const auto& all = node->type().outputs;
    const auto found = std::ranges::find(all, output, &OutputInfo::name);
    EXPECT_NE(found, all.end()) << output;
    const auto number = static_cast<size_t>(found - all.begin());
    std::vector<std::pair<std::string, Field>> outputs;
    for (const Field field : fields_of(lowering.answer(*node, number, point))) outputs.emplace_back("v", field);
    context.finish_bodies();
    const program::Program program = program::inline_bodies(builder.finish(outputs));
    std::vector<double> values, result;
    evaluate_point(program, p, values);
    for (const auto id : program.outputs) result.push_back(values[id]);
    return result;
  }
  double number_at(const NodePtr& node, const std::string& output, Vec3 p) { return at(node, output, p)[0]; }
  Vec3 vector_at(const NodePtr& node, const std::string& output, Vec3 p) {
    const auto v = at(node, output, p);
    return {v[0], v[1], v[2]};
  }

  Vec3 random_point(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    return {any(random_), any(random_), any(random_)};
  }

  MaterialTable materials_;
  Diagnostics diagnostics_;
  BallLoader loader_;
  std::mt19937 random_{11};
};

inline void expect_near(Vec3 a, Vec3 b, double tolerance) { EXPECT_LE(length(a - b), tolerance); }

inline constexpr double pi = 3.14159265358979323846;

}  // namespace ombre::nodes::test
