// Helpers for tests of value nodes: lists, numbers and vectors of outputs, and random points.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "design/attributes.h"
#include "design/test_designs.h"
#include "nodes/all_nodes.h"
#include "nodes/test_sources.h"

namespace ombre::nodes::test {

using namespace design;

class ValueTest : public design::test::DesignTest {
 protected:
  ValueTest()
      : DesignTest(registry(), R"({"name": "red", "r": 255, "g": 0, "b": 0}, {"name": "blue", "r": 0, "g": 0, "b": 255},
                                  {"name": "clear", "r": 4, "g": 4, "b": 4})",
                   &balls_) {}

  std::string error_of(const std::string& type, const Named& values, std::vector<NodePtr> inputs = {}) {
    diagnostics_ = {};
    EXPECT_FALSE(try_make(type, values, std::move(inputs)));
    return to_text(diagnostics_);
  }

  static Data rows(std::initializer_list<std::initializer_list<double>> numbers) {
    DataList data;
    for (const auto& row : numbers) data.push_back(list(row));
    return Data(std::move(data));
  }

  double number_at(const NodePtr& node, const std::string& output, Vec3 p) { return of_output(node, output, p)[0]; }
  Vec3 vector_at(const NodePtr& node, const std::string& output, Vec3 p) {
    const auto v = of_output(node, output, p);
    return {v[0], v[1], v[2]};
  }

  Vec3 random_point(double size) {
    std::uniform_real_distribution<double> any(-size, size);
    return {any(random_), any(random_), any(random_)};
  }

  BallLoader balls_;
  std::mt19937 random_{11};
};

inline void expect_near(Vec3 a, Vec3 b, double tolerance) { EXPECT_LE(length(a - b), tolerance); }

inline constexpr double pi = 3.14159265358979323846;

}  // namespace ombre::nodes::test
