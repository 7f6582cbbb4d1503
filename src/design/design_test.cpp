// Tests of node graphs with nodes defined here: typed inputs and outputs, sharing, hashes.
#include "design/design.h"

#include <gtest/gtest.h>

#include "design/test_designs.h"

namespace ombre::design {
namespace {

// A node with an output of each type.
struct Ramp {
  Number slope = 1;
  MaterialName low, high;

  static Spec<Ramp> spec() {
    return {"ramp",
            "Rises along x.",
            {{"slope", &Ramp::slope, "Its slope"}, {"low", &Ramp::low, ""}, {"high", &Ramp::high, ""}},
            no_inputs,
            "",
            {{"value", &Ramp::value, "Its height"},
             {"share", &Ramp::share, "Its height from 0 to 1", Interval(0, 1)},
             {"gradient", &Ramp::gradient, "Its slopes"},
             {"mixture", &Ramp::mixture, "Of low and high"}}};
  }

  Field value(const Ask& ask) const { return ask.p.x * slope(ask.p); }
  Field share(const Ask& ask) const { return min(max(value(ask), 0.0), ask.p.constant(1)); }
  VectorField gradient(const Ask& ask) const { return {slope(ask.p), ask.p.constant(0), ask.p.constant(0)}; }
  Composition mixture(const Ask& ask) const {
    const Field t = share(ask);
    return {{{ask.in.material(low), 1.0 - t}, {ask.in.material(high), t}}, {}};
  }
};

struct Ball {
  Number radius = 1;
  MaterialName material;
  static Spec<Ball> spec() {
    return {"ball",
            "A ball.",
            {{"radius", &Ball::radius, "", unit::positive_mm}, {"material", &Ball::material, ""}},
            no_inputs,
            ""};
  }
  Box bounds(const Box& where) const {
    const double r = radius.range(where).hi;
    return Box::centered({r, r, r});
  }
  Field distance(const Point& p) const { return length(p.x, p.y, p.z) - radius(p); }
};

class Designs : public test::DesignTest {
 protected:
  Designs() : DesignTest(test::registry_of<Ramp, Ball, test::Moved, test::Joined>(), test::red_and_blue) {}

  static Data formula(const std::string& text, const NodePtr& node, const std::string& name) {
    return Data(DataMembers{{"formula", Data(text)}, {"with", Data(DataMembers{{"v", output(node, name)}})}});
  }

  // Returns a ball whose radius is 5 where x <= 0, and grows by x/2 from there.
  NodePtr egg() { return make("ball", {{"radius", formula("5 + v/2", make("ramp", {}), "value")}}); }
};

}  // namespace

TEST_F(Designs, NumbersMayBeOutputsOfNodes) {
  const NodePtr ramp = make("ramp", {{"slope", Data(2.0)}});
  const NodePtr ball = make("ball", {{"radius", output(ramp, "value")}});
  ASSERT_TRUE(ball) << to_text(diagnostics_);
  EXPECT_EQ(distance(ball, {3, 4, 0}), 5 - 6);
  EXPECT_EQ(distance(make("ball", {{"radius", formula("1 + v^2", ramp, "value")}}), {3, 4, 0}), 5 - 37);
  EXPECT_EQ(distance(make("ball", {{"radius", output(ramp, "gradient.x")}}), {3, 4, 0}), 5 - 2);
}

TEST_F(Designs, ValuesAreEvaluatedWhereTheirSolidIs) {
  const NodePtr moved = make("moved", {{"by", list({1, 0, 0})}}, {egg()});
  EXPECT_EQ(distance(moved, {4, 4, 0}), 5 - 6.5);
}

TEST_F(Designs, ValuesMayUseValues) {
  const NodePtr steep = make("ramp", {{"slope", output(make("ramp", {}), "value")}});  // its value is x^2
  const NodePtr ball = make("ball", {{"radius", output(steep, "value")}});
  EXPECT_EQ(distance(ball, {3, 4, 0}), 5 - 9);
  EXPECT_EQ(ball->depth(), 3);
}

TEST_F(Designs, MaterialsMayBeMixtures) {
  const NodePtr ramp = make("ramp", {{"slope", Data(0.25)}, {"low", Data("red")}, {"high", Data("blue")}});
  const NodePtr ball = make("ball", {{"material", output(ramp, "mixture")}});
  ASSERT_TRUE(ball) << to_text(diagnostics_);
  LoweringContext context(materials_, {ball});
  program::Builder builder;
  Lowering lowering(context, builder);
  const Composition mixed = lowering.composition(*ball, Point::origin_frame(builder), Demand::inside);
  ASSERT_EQ(mixed.fractions.size(), 2u);
  const program::Program program =
      builder.finish({{"red", mixed.fractions[0].second}, {"blue", mixed.fractions[1].second}});
  std::vector<double> values;
  evaluate_point(program, {1, 0, 0}, values);
  EXPECT_EQ(values[program.outputs[0]], 0.75);
  EXPECT_EQ(values[program.outputs[1]], 0.25);
}

TEST_F(Designs, BoundsUseTheRangesOfValues) {
  // Within the box x is at most 8, so the radius is at most 9.
  const Box box{{-8, -20, -20}, {8, 20, 20}};
  EXPECT_EQ(egg()->bounds(box), (Box{{-8, -9, -9}, {8, 9, 9}}));
  // A declared range holds at every point.
  const NodePtr ball = make("ball", {{"radius", formula("5 + v", make("ramp", {}), "share")}});
  EXPECT_EQ(ball->bounds(design_space()), Box::centered({6, 6, 6}));
}

TEST_F(Designs, ValuesAreWrittenInVersion2) {
  EXPECT_EQ(json_of(make("ball", {})).find("version")->number()[0], 1);
  const NodePtr ramp = make("ramp", {{"low", Data("blue")}});
  const NodePtr ball =
      make("ball", {{"radius", formula("5 + v/2", ramp, "value")}, {"material", output(ramp, "mixture")}});
  const std::string text = print_json(json_of(ball));
  EXPECT_NE(text.find("\"version\": 2"), std::string::npos) << text;
  EXPECT_NE(text.find(R"({"from": "n1", "output": "mixture"})"), std::string::npos) << text;
  const auto again = read_design(*parse_json(make_source("d", text), diagnostics_), registry_, nullptr, diagnostics_);
  ASSERT_TRUE(again) << to_text(diagnostics_);
  EXPECT_EQ(print_json(to_data(*again)), text);
  EXPECT_EQ(hash(*again), hash({materials_, {{"part", ball}}, std::nullopt}));
  EXPECT_EQ(distance(again->parts[0].solid, {4, 3, 0}), 5 - 7);
}

TEST_F(Designs, HashesTellValuesApart) {
  const auto hash_of = [&](const Data& slope, const std::string& text) {
    const NodePtr ball = make("ball", {{"radius", formula(text, make("ramp", {{"slope", slope}}), "value")}});
    return hash({materials_, {{"part", ball}}, std::nullopt});
  };
  EXPECT_EQ(hash_of(Data(1.0), "5 + v"), hash_of(Data(1.0), "5+V"));
  EXPECT_NE(hash_of(Data(1.0), "5 + v"), hash_of(Data(2.0), "5 + v"));
  EXPECT_NE(hash_of(Data(1.0), "5 + v"), hash_of(Data(1.0), "6 + v"));
}

TEST_F(Designs, ValuesInTheWrongPlaceAreErrors) {
  const NodePtr ramp = make("ramp", {});
  EXPECT_FALSE(try_make("moved", {}, {ramp}));
  EXPECT_FALSE(try_make("ball", {{"radius", output(ramp, "gradient")}}));
  EXPECT_FALSE(try_make("ball", {{"radius", output(ramp, "vlaue")}}));
  EXPECT_FALSE(try_make("ball", {{"material", output(ramp, "value")}}));
  EXPECT_FALSE(try_make("moved", {{"by", object(ramp)}}, {egg()}));
  EXPECT_EQ(to_text(diagnostics_),
            R"(error: moved takes solids, ramp gives values; give it as a parameter, for example sphere(5 + noise());
error: expected a number, found the vector "gradient" of ramp; write one of its parts: .gradient.x
error: this ramp has no output "vlaue"; ramp gives value, share, gradient, mixture
error: material of ball: expected a material or a mixture of materials, found a number that varies in space; write for example mix(white, black, t)
error: by of moved: expected three numbers (x, y, z), found a value of ramp; this varies in space, so it is known only where the job evaluates it; write a constant
)");
}

TEST_F(Designs, ASolidUnderSeveralFramesIsOneBody) {
  const NodePtr ball = make("ball", {{"radius", Data(2.0)}});
  const NodePtr two =
      make("joined", {},
           {make("moved", {{"by", list({5, 0, 0})}}, {ball}), make("moved", {{"by", list({-5, 0, 0})}}, {ball})});
  size_t calls = 0;
  EXPECT_EQ(distance(two, {9, 0, 0}, &calls), 2);
  EXPECT_EQ(distance(two, {-4, 0, 0}), -1);
  EXPECT_EQ(calls, 2u);
}

// With so many inputs, a quadratic search would take minutes.
TEST_F(Designs, NodesWithVeryManyInputsAreRead) {
  constexpr size_t count = 150'000;
  DataList nodes, inputs;
  for (size_t n = 0; n < count; ++n) {
    const std::string id = "n" + std::to_string(n);
    nodes.emplace_back(DataMembers{{"id", Data(id)}, {"type", Data("ball")}});
    inputs.emplace_back(id);
  }
  nodes.insert(nodes.begin(),
               Data(DataMembers{{"id", Data("all")}, {"type", Data("joined")}, {"inputs", Data(inputs)}}));
  const Data part(DataMembers{{"name", Data("part")}, {"node", Data("all")}});
  DataMembers file{{"format", Data("ombre-design")}, {"version", Data(1.0)}};
  file.push_back(materials_.to_data().members()->front());
  file.emplace_back("nodes", Data(std::move(nodes)));
  file.emplace_back("parts", Data(DataList{part}));
  const auto design = read_design(Data(std::move(file)), registry_, nullptr, diagnostics_);
  ASSERT_TRUE(design) << to_text(diagnostics_);
  EXPECT_EQ(design->parts[0].solid->inputs().size(), count);
}

// Each level uses the one below twice, which makes 2^40 paths.
TEST_F(Designs, SharedNodesAreQueriedOnce) {
  NodePtr node = make("ball", {});
  for (int level = 0; level < 40; ++level) node = make("joined", {}, {node, node});
  EXPECT_EQ(distance(node, {3, 0, 0}), 2);
  EXPECT_EQ(node->bounds(design_space()), Box::centered({1, 1, 1}));
  EXPECT_EQ(topological({node}).size(), 41u);
  const Design design{materials_, {{"part", node}}, std::nullopt};
  EXPECT_LT(to_tree(design).size(), 10000u);
  EXPECT_EQ(hash(design).hex().size(), 32u);
}

TEST_F(Designs, NumbersMayBeFields) {
  const NodePtr wavy = make("ball", {{"radius", Data("2 + x/10")}});
  EXPECT_EQ(distance(wavy, {5, 0, 0}), 2.5);
  EXPECT_TRUE(wavy->metric().is_implicit());
  EXPECT_EQ(make("ball", {})->metric(), Metric::exact());
}

TEST_F(Designs, HashesLeaveOutWhatDoesNotMatter) {
  const auto hash_of = [&](const Data& radius, const Data& material) {
    return hash({materials_, {{"part", make("ball", {{"radius", radius}, {"material", material}})}}, std::nullopt});
  };
  const Hash plain = hash_of(Data(2.0), Data("Red"));
  EXPECT_EQ(hash_of(Data(2.0), Data("red")), plain);   // case is ignored
  EXPECT_EQ(hash_of(Data(2.0), Data(1.0)), plain);     // a material's number
  EXPECT_EQ(hash_of(Data(2.0), Data("")), plain);      // the default
  EXPECT_EQ(hash_of(Data("1 + 1"), Data("")), plain);  // a constant expression
  EXPECT_NE(hash_of(Data(2.5), Data("Red")), plain);
  EXPECT_EQ(hash_of(Data("X+ 1"), Data("")), hash_of(Data("(x + 1)"), Data("")));
  EXPECT_NE(hash_of(Data("x + 1"), Data("")), hash_of(Data("1 + x"), Data("")));
}

TEST_F(Designs, TooDeepIsAnError) {
  NodePtr node = make("ball", {});
  for (int level = 0; level < 1000 && node; ++level) node = try_make("moved", {{"by", list({1, 0, 0})}}, {node});
  EXPECT_FALSE(node);
  EXPECT_EQ(to_text(diagnostics_), "error: the design nests deeper than 400 nodes\n");
}

}  // namespace ombre::design
