// Graphs of nodes: typed inputs and outputs, sharing, hashes. With nodes made for these tests.
#include "design/design.h"

#include <gtest/gtest.h>

#include "base/json.h"
#include "design/lowering.h"
#include "design/spec.h"
#include "program/passes/passes.h"

namespace ombre::design {
namespace {

// A node that gives a field, and one that takes it: no mechanism of their own is needed.
struct Ramp {
  double slope = 1;
  static Spec<Ramp> spec() {
    return {"ramp", "test", "A field.", {{"slope", &Ramp::slope, "Its slope"}}, no_inputs, "", ValueType::field};
  }
  Field value(const Inputs&, const Point& p) const { return p.x * slope; }
};

struct Below {
  static Spec<Below> spec() {
    return {"below", "test", "Where a field is 0 or less.", {}, {ValueType::field, 1, 1}, ""};
  }
  Box reach(const Inputs&, const Box& where, double) const { return where; }
  Metric metric(const Inputs&) const { return Metric::implicit(); }
  Field distance(const Inputs& in, const Point& p) const { return in.value(0, p); }
};

struct Ball {
  Number radius = 1;
  MaterialName material;
  static Spec<Ball> spec() {
    return {"ball",    "test",
            "A ball.", {{"radius", &Ball::radius, "", unit::positive_mm}, {"material", &Ball::material, ""}},
            no_inputs, ""};
  }
  Box bounds(const Box& where) const {
    const double r = radius.range(where).hi;
    return Box::centered({r, r, r});
  }
  Field distance(const Point& p) const { return length(p.x, p.y, p.z) - radius(p); }
};

struct Shift {
  Vec3 by;
  static Spec<Shift> spec() { return {"shift", "test", "Moved.", {{"by", &Shift::by, ""}}, one_solid, ""}; }
  Point inner(const Point& p) const { return p.mapped(Affine::translation(-by)); }
  double scale() const { return 1; }
  Box reach(const Inputs& in, const Box& where, double margin) const {
    const Affine map = Affine::translation(by);
    return image(map, in.reach(0, image(inverse(map), where), margin));
  }
};

struct Any {
  static Spec<Any> spec() { return {"any", "test", "Union.", {}, many_solids, ""}; }
  Box reach(const Inputs& in, const Box& where, double margin) const {
    Box box;
    for (size_t i = 0; i < in.count(); ++i) box = hull(box, in.reach(i, where, margin));
    return box;
  }
  Field distance(const Inputs& in, const Point& p) const { return program::fold(in.distances(p), program::min); }
};

class Designs : public testing::Test {
 protected:
  Designs() {
    registry_.add<Ramp, Below, Ball, Shift, Any>();
    materials_ = *MaterialTable::read(
        *parse_json(make_source("m", R"({"materials": [{"name": "Red", "r": 1, "g": 2, "b": 3}]})"), diagnostics_),
        diagnostics_);
  }

  NodePtr make(const std::string& type, const std::vector<std::pair<std::string, Data>>& values,
               std::vector<NodePtr> inputs = {}) {
    const NodeType& t = *registry_.find(type);
    std::vector<NamedValue> named;
    for (const auto& [name, data] : values)
      named.push_back({&t.parameters[static_cast<size_t>(t.parameter(name))], data});
    return make_node(t, named, std::move(inputs), {materials_, diagnostics_, nullptr, {}, "", ""});
  }

  double distance(const NodePtr& node, Vec3 p, size_t* bodies = nullptr) {
    LoweringContext context(materials_, {node});
    program::Builder builder;
    Lowering lowering(context, builder);
    const Field g = lowering.distance(*node, Point::origin_frame(builder));
    context.finish_bodies();
    const program::Program called = builder.finish({{"g", g}});
    if (bodies) *bodies = called.calls.size();
    const program::Program flat = program::inline_bodies(called);
    std::vector<double> values;
    evaluate_point(flat, p, values);
    return values[flat.outputs[0]];
  }

  Registry registry_;
  MaterialTable materials_;
  Diagnostics diagnostics_;
};

}  // namespace

TEST_F(Designs, NodesMayGiveAndTakeFields) {
  const NodePtr solid = make("below", {}, {make("ramp", {{"slope", Data(2.0)}})});
  ASSERT_TRUE(solid);
  EXPECT_EQ(distance(solid, {3, 0, 0}), 6);
}

TEST_F(Designs, InputsOfTheWrongTypeAreErrors) {
  EXPECT_FALSE(make("shift", {}, {make("ramp", {})}));
  EXPECT_EQ(to_text(diagnostics_), "error: shift takes a solid, ramp gives a field\n");
}

TEST_F(Designs, ASolidUnderSeveralFramesIsOneBody) {
  const NodePtr ball = make("ball", {{"radius", Data(2.0)}});
  const NodePtr two = make("any", {},
                           {make("shift", {{"by", Data(DataList{Data(5.0), Data(0.0), Data(0.0)})}}, {ball}),
                            make("shift", {{"by", Data(DataList{Data(-5.0), Data(0.0), Data(0.0)})}}, {ball})});
  size_t calls = 0;
  EXPECT_EQ(distance(two, {9, 0, 0}, &calls), 2);
  EXPECT_EQ(distance(two, {-4, 0, 0}), -1);
  EXPECT_EQ(calls, 2u);
}

// So many that looking through all of a node's inputs for each of them would take minutes.
TEST_F(Designs, NodesWithVeryManyInputsAreRead) {
  constexpr size_t count = 150'000;
  DataList nodes, inputs;
  for (size_t n = 0; n < count; ++n) {
    const std::string id = "n" + std::to_string(n);
    nodes.emplace_back(DataMembers{{"id", Data(id)}, {"type", Data("ball")}});
    inputs.emplace_back(id);
  }
  nodes.insert(nodes.begin(), Data(DataMembers{{"id", Data("all")}, {"type", Data("any")}, {"inputs", Data(inputs)}}));
  const Data part(DataMembers{{"name", Data("part")}, {"node", Data("all")}});
  DataMembers file{{"format", Data("ombre-design")}, {"version", Data(1.0)}};
  file.push_back(materials_.to_data().members()->front());
  file.emplace_back("nodes", Data(std::move(nodes)));
  file.emplace_back("parts", Data(DataList{part}));
  const auto design = read_design(Data(std::move(file)), registry_, nullptr, diagnostics_);
  ASSERT_TRUE(design) << to_text(diagnostics_);
  EXPECT_EQ(design->parts[0].solid->inputs().size(), count);
}

// Each level uses the one below twice: 2^40 paths.
TEST_F(Designs, SharedNodesAreAskedOnce) {
  NodePtr node = make("ball", {});
  for (int level = 0; level < 40; ++level) node = make("any", {}, {node, node});
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
  EXPECT_EQ(hash_of(Data(2.0), Data("red")), plain);   // case
  EXPECT_EQ(hash_of(Data(2.0), Data(1.0)), plain);     // a material's number
  EXPECT_EQ(hash_of(Data(2.0), Data("")), plain);      // the default
  EXPECT_EQ(hash_of(Data("1 + 1"), Data("")), plain);  // a constant expression
  EXPECT_NE(hash_of(Data(2.5), Data("Red")), plain);
  EXPECT_EQ(hash_of(Data("X+ 1"), Data("")), hash_of(Data("(x + 1)"), Data("")));
  EXPECT_NE(hash_of(Data("x + 1"), Data("")), hash_of(Data("1 + x"), Data("")));
}

TEST_F(Designs, TooDeepIsAnError) {
  NodePtr node = make("ball", {});
  for (int level = 0; level < 1000 && node; ++level)
    node = make("shift", {{"by", Data(DataList{Data(1.0), Data(0.0), Data(0.0)})}}, {node});
  EXPECT_FALSE(node);
  EXPECT_EQ(to_text(diagnostics_), "error: the design nests deeper than 400 nodes\n");
}

}  // namespace ombre::design
