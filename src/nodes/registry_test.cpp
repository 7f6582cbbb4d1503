// Tests properties that every node of the registry must have, with random parameters.
#include <gtest/gtest.h>

#include "base/text/json.h"
#include "base/text/text.h"
#include "design/design.h"
#include "design/lowering.h"
#include "nodes/all_nodes.h"
#include "nodes/test_random_designs.h"
#include "program/evaluate.h"
#include "program/gradient.h"
#include "program/passes/passes.h"
#include "program/program_text.h"

namespace ombre::nodes {
namespace {

using namespace design;
using test::BallLoader;
using test::RandomDesign;
using test::test_materials;

struct Lowered {
  program::Program program;  // outputs: inside, interior, distance, then fractions
  size_t fraction_count = 0;
  size_t check_count = 0;
};

Lowered lower(const NodePtr& node, const MaterialTable& materials, Demand demand) {
  LoweringContext context(materials, {node});
  program::Builder builder;
  Lowering lowering(context, builder);
  const Point p = Point::origin_frame(builder);
  std::vector<std::pair<std::string, Field>> outputs{{"inside", lowering.inside(*node, p)},
                                                     {"interior", lowering.membership(*node, p, Border::excluded)},
                                                     {"distance", lowering.distance(*node, p)}};
  const Composition composition = lowering.composition(*node, p, demand);
  for (const auto& [id, fraction] : composition.fractions) outputs.emplace_back("fraction", fraction);
  for (const auto& [number, flag] : composition.checks) outputs.emplace_back("check", flag);
  context.finish_bodies();
  const program::Program whole = program::inline_bodies(builder.finish(outputs));
  // Includes all rows of tables.
  std::vector<Interval> ranges;
  evaluate_intervals(whole, Box::centered({1e4, 1e4, 1e4}), ranges);
  return {program::expand_parts(whole, ranges, program::Precision::reference), composition.fractions.size(),
          composition.checks.size()};
}

std::vector<double> at(const program::Program& program, Vec3 p) {
  std::vector<double> values, outputs;
  evaluate_point(program, p, values);
  for (const auto id : program.outputs) outputs.push_back(values[id]);
  return outputs;
}

Data round_trip(const NodePtr& node, const MaterialTable& materials) {
  return to_data({materials, {{"part", node}}, std::nullopt});
}

// True if the node gives this output, and it varies in space.
bool varies(const Node& node, size_t output) {
  return node.gives(output) && node.type().outputs[output].type.form != OutputForm::constant;
}

// Returns the numbers of a value node's outputs, with vectors as three numbers, and the fractions of its mixture. A
// solid counts as one number.
program::Program lower_outputs(const NodePtr& node, const MaterialTable& materials) {
  LoweringContext context(materials, {node});
  program::Builder builder;
  Lowering lowering(context, builder);
  const Point p = Point::origin_frame(builder);
  std::vector<std::pair<std::string, Field>> outputs;
  for (size_t n = 0; n < node->type().outputs.size(); ++n) {
    const OutputInfo& info = node->type().outputs[n];
    if (!varies(*node, n)) continue;
    for (const Field field : fields_of(lowering.answer(*node, n, p))) outputs.emplace_back(info.name, field);
  }
  context.finish_bodies();
  return program::inline_bodies(builder.finish(outputs));
}

// Returns the numbers of a value node that have symbolic derivatives, each with its derivatives.
program::Program lower_derivatives(const NodePtr& node, const MaterialTable& materials) {
  LoweringContext context(materials, {node});
  program::Builder builder;
  Lowering lowering(context, builder);
  const Point p = Point::origin_frame(builder);
  program::Outputs outputs;
  const auto add = [&](const Field& value) {
    const auto by_rule = program::gradient(value, p);
    if (!by_rule) return;
    outputs.emplace_back("value", value);
    for (const Field& derivative : *by_rule) outputs.emplace_back("derivative", derivative);
  };
  for (size_t n = 0; n < node->type().outputs.size(); ++n) {
    if (!varies(*node, n)) continue;
    for (const Field number : lowering.answer(*node, n, p).numbers)
      if (number) add(number);
  }
  context.finish_bodies();
  return outputs.empty() ? program::Program() : program::inline_bodies(builder.finish(outputs));
}

class EveryNode : public testing::TestWithParam<std::string> {
 protected:
  const NodeType& type() const { return *registry().find(GetParam()); }
  // Checks nodes of the type with random parameters, over inputs of that depth.
  template <class Check>
  void for_designs(int depth, const Check& check) const {
    for (unsigned seed = 0; seed < rounds; ++seed) {
      RandomDesign random(seed);
      const NodePtr node = random.node(type(), depth);
      ASSERT_TRUE(node) << random.last_message;
      check(random, node);
      if (HasFatalFailure()) return;
    }
  }

#ifdef OMBRE_SANITIZED  // sanitizers make each round about twenty times as slow
  static constexpr unsigned rounds = 6;
#else
  static constexpr unsigned rounds = 30;
#endif
};

class EverySolid : public EveryNode {};
class EveryValue : public EveryNode {};

// Expects the bounds of a node to hold a point that is inside of it.
void expect_bounds(const Box& bounds, const program::Program& inside, const Vec3& p, const NodePtr& node,
                   RandomDesign& random) {
  if (at(inside, p)[0] == 0) return;
  EXPECT_TRUE(bounds.contains(p)) << print_json(round_trip(node, random.materials)) << p.x << " " << p.y << " " << p.z;
}

}  // namespace

TEST_P(EveryNode, IsDocumented) {
  EXPECT_FALSE(type().category.empty());
  EXPECT_EQ(type().sentence.back(), '.');
  EXPECT_FALSE(type().example.empty());
  for (const ParameterInfo& parameter : type().parameters) EXPECT_FALSE(parameter.doc.empty()) << parameter.name;
  for (const OutputInfo& output : type().outputs) EXPECT_FALSE(output.doc.empty()) << output.name;
}

TEST_P(EverySolid, BoundsHoldWhatIsInside) {
  for_designs(2, [&](RandomDesign& random, const NodePtr& node) {
    const Box where = Box::centered({40, 40, 40});
    const Box bounds = node->bounds(where).expanded(1e-9);
    const auto lowered = lower(node, random.materials, Demand::inside);
    for (int i = 0; i < 300; ++i) {
      const Vec3 p{random.number(-40, 40), random.number(-40, 40), random.number(-40, 40)};
      expect_bounds(bounds, lowered.program, p, node, random);
    }
  });
}

TEST_P(EverySolid, BoundsWithinABoxHoldWhatIsInsideOfBoth) {
  for_designs(2, [&](RandomDesign& random, const NodePtr& node) {
    const auto lowered = lower(node, random.materials, Demand::inside);
    for (int i = 0; i < 30; ++i) {
      const Vec3 lo{random.number(-12, 8), random.number(-12, 8), random.number(-12, 8)};
      const Vec3 size{random.number(0, 8), random.number(0, 8), random.number(0, 8)};
      const Box bounds = node->bounds({lo, lo + size}).expanded(1e-9);
      for (int j = 0; j < 20; ++j) {
        const Vec3 p{lo.x + size.x * random.number(0, 1), lo.y + size.y * random.number(0, 1),
                     lo.z + size.z * random.number(0, 1)};
        expect_bounds(bounds, lowered.program, p, node, random);
      }
    }
  });
}

TEST_P(EverySolid, IntervalsHoldPoints) {
  for_designs(2, [&](RandomDesign& random, const NodePtr& node) {
    const auto lowered = lower(node, random.materials, Demand::everywhere);
    for (int i = 0; i < 20; ++i) {
      const Vec3 lo{random.number(-10, 10), random.number(-10, 10), random.number(-10, 10)};
      const double size = random.number(0, 4);
      const Box box{lo, lo + Vec3{size, size, size}};
      std::vector<Interval> ranges;
      evaluate_intervals(lowered.program, box, ranges);
      const program::Program shorter = program::shorten(lowered.program, ranges);
      for (int n = 0; n < 10; ++n) {
        const Vec3 p = lo + Vec3{random.number(0, size), random.number(0, size), random.number(0, size)};
        std::vector<double> values;
        evaluate_point(lowered.program, p, values);
        for (size_t v = 0; v < values.size(); ++v)
          ASSERT_TRUE(ranges[v].contains(values[v]))
              << program::to_text(lowered.program) << "v" << v << " = " << values[v];
        // The program for the box gives the same bits.
        const auto whole = at(lowered.program, p), part = at(shorter, p);
        for (size_t o = 0; o < whole.size(); ++o)
          ASSERT_TRUE(whole[o] == part[o] || (std::isnan(whole[o]) && std::isnan(part[o]))) << o;
      }
    }
  });
}

TEST_P(EverySolid, InsideAgreesWithDistance) {
  for_designs(2, [&](RandomDesign& random, const NodePtr& node) {
    const auto lowered = lower(node, random.materials, Demand::inside);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p{random.number(-12, 12), random.number(-12, 12), random.number(-12, 12)};
      const auto values = at(lowered.program, p);
      if (std::abs(values[2]) < 1e-9) continue;  // rounding may change the sign
      EXPECT_EQ(values[0], values[2] <= 0 ? 1 : 0) << values[2] << print_json(round_trip(node, random.materials));
      EXPECT_EQ(values[1], values[2] < 0 ? 1 : 0);
    }
  });
}

TEST_P(EverySolid, FractionsSumToOne) {
  for_designs(2, [&](RandomDesign& random, const NodePtr& node) {
    for (const Demand demand : {Demand::inside, Demand::everywhere}) {
      const auto lowered = lower(node, random.materials, demand);
      for (int i = 0; i < 200; ++i) {
        const Vec3 p{random.number(-9, 9), random.number(-9, 9), random.number(-9, 9)};
        const auto values = at(lowered.program, p);
        if (demand == Demand::inside && values[0] == 0) continue;
        double sum = 0;
        for (size_t f = 0; f < lowered.fraction_count; ++f) {
          EXPECT_GE(values[3 + f], 0);
          sum += values[3 + f];
        }
        ASSERT_NEAR(sum, 1, 1e-12) << print_json(round_trip(node, random.materials));
      }
    }
  });
}

// |g(p) - g(q)| <= L |p - q| must hold for exact and bounded g.
TEST_P(EverySolid, KeepsItsLipschitzBound) {
  for_designs(2, [&](RandomDesign& random, const NodePtr& node) {
    const Metric metric = node->metric();
    if (metric.is_implicit()) return;
    const auto lowered = lower(node, random.materials, Demand::inside);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p{random.number(-15, 15), random.number(-15, 15), random.number(-15, 15)};
      const Vec3 step{random.number(-1, 1), random.number(-1, 1), random.number(-1, 1)};
      const double here = at(lowered.program, p)[2], there = at(lowered.program, p + step)[2];
      if (here == there) continue;  // both may be infinite for empty solids
      const double change = std::abs(here - there);
      ASSERT_LE(change, metric.lipschitz * length(step) * (1 + 1e-9) + 1e-9)
          << print_json(round_trip(node, random.materials));
    }
  });
}

// From any point, a step of length |g| along the gradient of an exact distance leads to the surface.
TEST_P(EverySolid, ExactDistancesLeadToTheSurface) {
  for_designs(1, [&](RandomDesign& random, const NodePtr& node) {
    if (node->metric().kind != Metric::Kind::exact) return;
    const auto lowered = lower(node, random.materials, Demand::inside);
    const auto g = [&](Vec3 p) { return at(lowered.program, p)[2]; };
    for (int i = 0; i < 50; ++i) {
      const Vec3 p{random.number(-15, 15), random.number(-15, 15), random.number(-15, 15)};
      constexpr double h = 1e-5;
      const Vec3 gradient =
          (0.5 / h) * Vec3{g(p + Vec3{h, 0, 0}) - g(p - Vec3{h, 0, 0}), g(p + Vec3{0, h, 0}) - g(p - Vec3{0, h, 0}),
                           g(p + Vec3{0, 0, h}) - g(p - Vec3{0, 0, h})};
      if (std::abs(length(gradient) - 1) > 1e-4) continue;  // on the medial axis the gradient is undefined
      EXPECT_NEAR(g(p - g(p) * gradient), 0, 1e-3)
          << print_json(round_trip(node, random.materials)) << p.x << " " << p.y << " " << p.z;
    }
  });
}

// Prints the design, reads it, and prints it again.
void expect_same_when_read(const NodePtr& node, const MaterialTable& materials) {
  const Design design{materials, {{"part", node}}, std::nullopt};
  const std::string text = print_json(to_data(design));
  Diagnostics diagnostics;
  const auto data = parse_json(make_source("design.json", text), diagnostics);
  ASSERT_TRUE(data) << to_text(diagnostics);
  BallLoader loader;
  const auto again = read_design(*data, registry(), &loader, diagnostics);
  ASSERT_TRUE(again) << to_text(diagnostics) << text;
  EXPECT_EQ(print_json(to_data(*again)), text);
  EXPECT_EQ(hash(*again), hash(design));
}

TEST_P(EverySolid, PrintsAndReadsBack) {
  for_designs(3, [&](RandomDesign& random, const NodePtr& node) { expect_same_when_read(node, random.materials); });
}

TEST_P(EveryValue, PrintsAndReadsBack) {
  for_designs(1, [&](RandomDesign& random, const NodePtr& node) {
    const NodeType& attribute = *registry().find("attribute");
    Diagnostics diagnostics;
    for (size_t n = 0; n < type().outputs.size(); ++n) {
      const OutputInfo& output = type().outputs[n];
      const OutputForm form = output.type.form;
      if (!node->gives(n) || form == OutputForm::solid || form == OutputForm::constant) continue;
      const NodeType& user = *registry().find(form == OutputForm::mixture ? "sphere" : "attribute");
      const Data value(DataMembers{{"from", Data(HostObjectPtr(std::make_shared<NodeObject>(node)))},
                                   {"output", Data(output.name + (output.type.has_parts() ? ".y" : ""))}});
      std::vector<NamedValue> values{{&user.parameters[1], value}};
      std::vector<NodePtr> inputs;
      if (&user == &attribute) {
        values.push_back({&user.parameters[0], Data("density")});
        inputs.push_back(random.any_node(0));
      }
      const NodePtr solid = make_node(user, values, inputs, {random.materials, diagnostics, nullptr, {}, "", ""});
      ASSERT_TRUE(solid) << to_text(diagnostics);
      expect_same_when_read(solid, random.materials);
    }
  });
}

TEST_P(EveryValue, IntervalsHoldPoints) {
  for_designs(1, [&](RandomDesign& random, const NodePtr& node) {
    const program::Program program = lower_outputs(node, random.materials);
    for (int i = 0; i < 20; ++i) {
      const Vec3 lo{random.number(-50, 50), random.number(-50, 50), random.number(-50, 50)};
      const double size = i % 2 ? random.number(0, 1) : random.number(0, 8);
      std::vector<Interval> ranges;
      evaluate_intervals(program, {lo, lo + Vec3{size, size, size}}, ranges);
      for (int n = 0; n < 10; ++n) {
        const Vec3 p = lo + Vec3{random.number(0, size), random.number(0, size), random.number(0, size)};
        std::vector<double> values;
        evaluate_point(program, p, values);
        for (size_t v = 0; v < values.size(); ++v)
          ASSERT_TRUE(ranges[v].contains(values[v])) << program::to_text(program) << "v" << v << " = " << values[v];
      }
    }
  });
}

// Tests derivatives where a rule exists and the differences on both sides agree. Elsewhere the value has a kink or
// jump.
TEST_P(EveryValue, DerivativesMatchDifferences) {
  constexpr double step = 1e-5, part_of_step = 0.37e-5;
  for_designs(1, [&](RandomDesign& random, const NodePtr& node) {
    const program::Program program = lower_derivatives(node, random.materials);
    for (int i = 0; i < 20 && !program.outputs.empty(); ++i) {
      const Vec3 p{random.number(-9, 9), random.number(-9, 9), random.number(-9, 9)};
      const auto here = at(program, p);
      for (int axis = 0; axis < 3; ++axis) {
        Vec3 low = p, high = p, near = p;
        low[axis] -= step;
        high[axis] += step;
        near[axis] += part_of_step;
        const auto below = at(program, low), above = at(program, high), beside = at(program, near);
        for (size_t v = 0; v < here.size(); v += 4) {
          // Numbers of cells without volume are quotients by rounding errors, such as 2^60.
          if (!(std::abs(here[v]) < 1e12)) continue;
          const double up = (above[v] - here[v]) / step, down = (here[v] - below[v]) / step;
          const double scale = 1 + std::abs(here[v]) + std::abs(up);
          if (!(std::abs(up - down) < 1e-3 * scale)) continue;
          // A step may be longer than the period of a number that repeats in tiny cells.
          const double up_part = (beside[v] - here[v]) / part_of_step;
          if (!(std::abs(up - up_part) < 1e-3 * scale)) continue;
          EXPECT_NEAR(here[v + 1 + static_cast<size_t>(axis)], (up + down) / 2, 2e-3 * scale)
              << "number " << v / 4 << ", axis " << axis;
        }
      }
    }
  });
}

TEST_P(EveryValue, DeclaredRangesHoldPoints) {
  for_designs(1, [&](RandomDesign& random, const NodePtr& node) {
    const program::Program program = lower_outputs(node, random.materials);
    for (int i = 0; i < 300; ++i) {
      const auto values = at(program, {random.number(-90, 90), random.number(-90, 90), random.number(-90, 90)});
      size_t place = 0;
      for (size_t n = 0; n < type().outputs.size(); ++n) {
        const OutputInfo& output = type().outputs[n];
        if (!varies(*node, n) || output.type.form == OutputForm::mixture) continue;
        const bool is_number = output.type.is_number();
        EXPECT_TRUE(!is_number || output.range.contains(values[place])) << output.name;
        place += std::max<size_t>(1, output.type.parts.size());
      }
    }
  });
}

TEST_P(EveryValue, FractionsOfMixturesSumToOne) {
  for_designs(1, [&](RandomDesign& random, const NodePtr& node) {
    if (!node->is_mixture()) return;
    const program::Program program = lower_outputs(node, random.materials);
    size_t others = 0;  // numbers of the outputs after the mixture
    for (size_t n = node->first_output() + 1; n < type().outputs.size(); ++n)
      if (varies(*node, n)) others += std::max<size_t>(1, type().outputs[n].type.parts.size());
    for (int i = 0; i < 100; ++i) {
      double sum = 0;
      const auto values = at(program, {random.number(-9, 9), random.number(-9, 9), random.number(-9, 9)});
      ASSERT_GT(values.size(), others);
      for (const double fraction : std::span(values).first(values.size() - others)) {
        EXPECT_GE(fraction, 0);
        sum += fraction;
      }
      EXPECT_NEAR(sum, 1, 1e-12);
    }
  });
}

const auto by_name = [](const testing::TestParamInfo<std::string>& test) { return test.param; };
INSTANTIATE_TEST_SUITE_P(Registry, EveryNode, testing::ValuesIn(registry().names()), by_name);
INSTANTIATE_TEST_SUITE_P(Registry, EverySolid, testing::ValuesIn(registry().solid_names()), by_name);
INSTANTIATE_TEST_SUITE_P(Registry, EveryValue, testing::ValuesIn(registry().value_names()), by_name);

// Tests whole random trees instead of a single node at the top.
TEST(RandomTrees, HoldTheSameProperties) {
  for (unsigned seed = 1000; seed < 1150; ++seed) {
    RandomDesign random(seed);
    const NodePtr node = random.any_node(4);
    const auto lowered = lower(node, random.materials, Demand::inside);
    const Box bounds = node->bounds(Box::centered({60, 60, 60})).expanded(1e-9);
    for (int i = 0; i < 100; ++i) {
      const Vec3 p{random.number(-20, 20), random.number(-20, 20), random.number(-20, 20)};
      const auto values = at(lowered.program, p);
      if (values[0] == 0) continue;
      EXPECT_TRUE(bounds.contains(p)) << seed << " " << to_tree({random.materials, {{"part", node}}, std::nullopt})
                                      << p.x << " " << p.y << " " << p.z;
      double sum = 0;
      for (size_t f = 0; f < lowered.fraction_count; ++f) sum += values[3 + f];
      EXPECT_NEAR(sum, 1, 1e-12);
    }
  }
}

}  // namespace ombre::nodes
