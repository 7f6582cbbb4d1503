// Tests of types of parameters and outputs: a type of its own, and a node with an output of each form.
#include <gtest/gtest.h>

#include <cmath>

#include "design/test_designs.h"

namespace ombre::design {
namespace {

// A type that only one node has: two whole numbers, written "3:2".
struct Ratio {
  int over = 1, under = 1;
};

}  // namespace

template <>
struct Port<Ratio> {
  static PortText text(const Domain&) { return {"ratio", "ratios", "str"}; }
  static bool read(const Data& data, const Domain&, Ratio& value, const Reader& reader) {
    const std::string* text = data.string();
    if (!text || text->size() != 3 || (*text)[1] != ':')
      return reader.fail(data, "a ratio", "write for example \"3:2\"");
    value = {(*text)[0] - '0', (*text)[2] - '0'};
    return true;
  }
  static Data write(const Ratio& value, bool) {
    return Data(std::to_string(value.over) + ':' + std::to_string(value.under));
  }
};

namespace {

// Its outputs are of all types; their values follow from x alone.
struct Source {
  Ratio ratio;
  MaterialName low, high;

  static Spec<Source> spec() {
    return {"source",
            "Gives everything.",
            {{"ratio", &Source::ratio, ""}, {"low", &Source::low, ""}, {"high", &Source::high, ""}},
            no_inputs,
            "",
            {{"number", &Source::number, ""},
             {"vector", &Source::vector, ""},
             {"colour", &Source::colour, ""},
             {"frame", &Source::frame, ""},
             {"label", &Source::label, ""},
             {"pure", &Source::pure, ""},
             {"mixed", &Source::mixed, ""},
             {"ball", &Source::ball, &Source::around_ball, ""},
             {"half", &Source::half, &Source::everywhere, ""},
             {"name", &Source::name, ""},
             {"curve", &Source::curve, ""},
             {"profile", &Source::profile, ""},
             {"image", &Source::image, ""},
             {"count", &Source::count, ""},
             {"same", &Source::ratio, ""}}};
  }

  Field number(const Ask& ask) const { return ask.p.x * (1.0 * ratio.over / ratio.under); }
  VectorField vector(const Ask& ask) const { return {ask.p.x, ask.p.constant(2), ask.p.constant(3)}; }
  ColourField colour(const Ask& ask) const {
    return {ask.p.constant(0.25), ask.p.constant(0.5), ask.p.constant(0.75), ask.p.constant(1)};
  }
  Point frame(const Ask& ask) const { return ask.p.mapped(Affine::translation({1, 0, 0})); }
  LabelField label(const Ask& ask) const { return {ask.p.constant(7)}; }
  Composition pure(const Ask& ask) const { return Composition::pure(ask.in.material(low), ask.p.constant(1)); }
  Composition mixed(const Ask& ask) const {
    return {{{ask.in.material(low), ask.p.constant(0.25)}, {ask.in.material(high), ask.p.constant(0.75)}}, {}};
  }
  OutputSolid ball(const Ask& ask) const {
    return {length(ask.p.x, ask.p.y, ask.p.z) - 2, Composition::pure(ask.in.material(high), ask.p.constant(1))};
  }
  Box around_ball(const Box&) const { return Box::centered({2, 2, 2}); }
  Region half(const Ask& ask) const { return {less_equal(ask.p.constant(0), ask.p.x)}; }
  Box everywhere(const Box& where) const { return where; }
  std::string name() const { return "Blue"; }
  Points curve() const { return {{{0, 0, 0}, {1, 2, 3}}, false}; }
  std::vector<Points> profile() const { return {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, true}}; }
  FilePath image() const { return {"wood.png", {}}; }
  int count() const { return 3; }
};

// A ball with a parameter of many types; it shows what they are.
struct Sink {
  Number radius = 1;
  Numbers3 middle;
  MaterialName material;
  AttributeValue value;
  SolidName solid;
  std::string text;
  Points points;
  std::vector<Points> lists;
  FilePath file{"none.png", {}};
  int whole = 0;
  Ratio ratio;

  static Spec<Sink> spec() {
    return {"sink",
            "Takes everything.",
            {{"radius", &Sink::radius, ""},
             {"middle", &Sink::middle, ""},
             {"material", &Sink::material, ""},
             {"value", &Sink::value, ""},
             {"solid", &Sink::solid, ""},
             {"text", &Sink::text, ""},
             {"points", &Sink::points, ""},
             {"lists", &Sink::lists, ""},
             {"file", &Sink::file, ""},
             {"whole", &Sink::whole, ""},
             {"ratio", &Sink::ratio, ""}},
            no_inputs,
            ""};
  }
  Box bounds(const Box&) const { return Box::centered({9, 9, 9}); }
  // The distance to the given solid, or that of a ball.
  Field distance(const Inputs& in, const Point& p) const {
    if (solid.node) return in.distance_to(solid, p);
    return length(p.x - middle.x(p), p.y - middle.y(p), p.z - middle.z(p)) - radius(p);
  }
};

// Struts whose output `along` others pass on, and a map.
struct Rod {
  static Spec<Rod> spec() {
    return {"rod", "A rod.", {}, no_inputs, "", {{"along", &Rod::along, ""}, {"place", &Rod::place, ""}}};
  }
  Box bounds(const Box&) const { return Box::centered({5, 1, 1}); }
  Field distance(const Point& p) const { return max(length(p.y, p.z) - 1, abs(p.x) - 5); }
  Field along(const Ask& ask) const { return ask.p.x * 0.1 + 0.5; }
  VectorField place(const Ask& ask) const { return {ask.p.x, ask.p.y, ask.p.z}; }
};

class Ports : public test::DesignTest {
 protected:
  Ports() : DesignTest(test::registry_of<Source, Sink, Rod, test::Moved, test::Joined>(), test::red_and_blue) {}

  NodePtr source() { return make("source", {{"ratio", Data("3:2")}, {"low", Data("Red")}, {"high", Data("Blue")}}); }
  double named_output(const NodePtr& node, const std::string& name, Vec3 p) {
    return values(node, p, [&](Lowering& lowering, const Point& at) {
      return std::vector{lowering.output(*node, name, at)[0]};
    })[0];
  }
  // Returns the fractions of materials in the order of their ids.
  std::vector<double> composition(const NodePtr& node, Vec3 p) {
    return values(node, p, [&](Lowering& lowering, const Point& at) {
      return fields_of({{}, lowering.composition(*node, at, Demand::inside)});
    });
  }
  Data parameter(const NodePtr& node, const std::string& name) {
    return node->type().get(*node, static_cast<size_t>(node->type().parameter(name)), false);
  }
  // True if a design with the node is the same when it is written as JSON and read again.
  bool reads_back(const NodePtr& node) {
    const Data file = json_of(node);
    const auto design = read_design(file, registry_, nullptr, diagnostics_);
    EXPECT_TRUE(design) << to_text(diagnostics_);
    return design && print_json_line(to_data(*design)) == print_json_line(file);
  }
};

using Numbers = std::vector<double>;

TEST_F(Ports, OutputsThatVaryHaveTheirNumbers) {
  const NodePtr node = source();
  EXPECT_EQ(of_output(node, "number", {4, 0, 0}), (Numbers{6}));
  EXPECT_EQ(of_output(node, "vector", {4, 0, 0}), (Numbers{4, 2, 3}));
  EXPECT_EQ(of_output(node, "colour", {4, 0, 0}), (Numbers{0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(of_output(node, "frame", {4, 5, 6}), (Numbers{5, 5, 6}));
  EXPECT_EQ(of_output(node, "label", {4, 0, 0}), (Numbers{7}));
  EXPECT_EQ(of_output(node, "pure", {4, 0, 0}), (Numbers{1}));
  EXPECT_EQ(of_output(node, "mixed", {4, 0, 0}), (Numbers{0.25, 0.75}));
}

TEST_F(Ports, TypesOfOutputsHaveNames) {
  std::vector<std::string> names;
  for (const OutputInfo& output : registry_.find("source")->outputs) names.push_back(output.type.name);
  EXPECT_EQ(names, (std::vector<std::string>{"number", "vector", "colour", "frame", "label", "mixture", "mixture",
                                             "solid", "region", "text", "list of points", "list of lists of points",
                                             "file", "whole number", "ratio"}));
}

TEST_F(Ports, NumbersOfOutputsGoIntoFormulas) {
  const NodePtr node = source();
  EXPECT_EQ(distance(make("sink", {{"radius", output(node, "number")}}), {4, 0, 0}), 4 - 6);
  EXPECT_EQ(distance(make("sink", {{"radius", output(node, "colour.b")}}), {4, 0, 0}), 4 - 0.75);
  EXPECT_EQ(distance(make("sink", {{"radius", output(node, "frame.x")}}), {4, 0, 0}), 4 - 5);
  EXPECT_EQ(distance(make("sink", {{"radius", output(node, "label")}}), {4, 0, 0}), 4 - 7);
}

TEST_F(Ports, VectorsAndFramesAreThreeNumbers) {
  for (const char* name : {"vector", "frame"}) {
    const NodePtr sink = make("sink", {{"middle", output(source(), name)}});
    ASSERT_TRUE(sink) << to_text(diagnostics_);
    // The vector is (x, 2, 3), and the frame (x + 1, y, z).
    const double expected = name[0] == 'v' ? std::sqrt(4 + 9) - 1 : 0;
    EXPECT_NEAR(distance(sink, {4, 0, 0}), expected, 1e-12);
    EXPECT_TRUE(reads_back(sink));
  }
}

TEST_F(Ports, ANodeMayHaveSeveralMixtures) {
  const NodePtr node = source();
  EXPECT_EQ(composition(make("sink", {{"material", output(node, "pure")}}), {0, 0, 0}), (Numbers{1}));
  const NodePtr mixed = make("sink", {{"material", output(node, "mixed")}});
  EXPECT_EQ(composition(mixed, {0, 0, 0}), (Numbers{0.25, 0.75}));
  EXPECT_TRUE(reads_back(mixed));
}

TEST_F(Ports, ColoursAreAttributes) {
  const NodePtr sink = make("sink", {{"value", output(source(), "colour")}});
  ASSERT_TRUE(sink) << to_text(diagnostics_);
  EXPECT_EQ(parameter(sink, "value").list()->size(), 4u);
}

TEST_F(Ports, SolidsAndRegionsAreSolids) {
  const NodePtr ball = make("sink", {{"solid", output(source(), "ball")}});
  EXPECT_EQ(distance(ball, {5, 0, 0}), 3);
  EXPECT_TRUE(reads_back(ball));
  const NodePtr half = make("sink", {{"solid", output(source(), "half")}});
  EXPECT_LT(distance(half, {1, 0, 0}), 0);
  EXPECT_GT(distance(half, {-1, 0, 0}), 0);
  const auto number = *registry_.find("source")->output("ball");
  EXPECT_EQ(source()->output_bounds(number, design_space()), Box::centered({2, 2, 2}));
}

TEST_F(Ports, ConstantsGoWhereTheirTypeGoes) {
  const NodePtr node = source();
  const NodePtr sink = make("sink", {{"text", output(node, "name")},
                                     {"points", output(node, "curve")},
                                     {"lists", output(node, "profile")},
                                     {"file", output(node, "image")},
                                     {"whole", output(node, "count")},
                                     {"ratio", output(node, "same")},
                                     {"material", output(node, "name")}});
  ASSERT_TRUE(sink) << to_text(diagnostics_);
  EXPECT_EQ(print_json_line(parameter(sink, "text")), "\"Blue\"");
  EXPECT_EQ(print_json_line(parameter(sink, "points")), "[[0,0,0],[1,2,3]]");
  EXPECT_EQ(print_json_line(parameter(sink, "lists")), "[[[0,0],[1,0],[0,1]]]");
  EXPECT_EQ(print_json_line(parameter(sink, "file")), "\"wood.png\"");
  EXPECT_EQ(print_json_line(parameter(sink, "whole")), "3");
  EXPECT_EQ(print_json_line(parameter(sink, "ratio")), "\"3:2\"");
  EXPECT_EQ(print_json_line(parameter(sink, "material")), "\"Blue\"");
}

TEST_F(Ports, OutputsOfTheWrongTypeAreErrors) {
  const NodePtr node = source();
  EXPECT_FALSE(try_make("sink", {{"radius", output(node, "ball")}}));
  EXPECT_FALSE(try_make("sink", {{"solid", output(node, "number")}}));
  EXPECT_FALSE(try_make("sink", {{"whole", output(node, "name")}}));
  EXPECT_FALSE(try_make("sink", {{"ratio", Data(2.0)}}));
  EXPECT_FALSE(try_make("sink", {{"radius", output(node, "colour")}}));
  EXPECT_EQ(to_text(diagnostics_),
            R"(error: expected a number, found the solid "ball" of source
error: solid of sink: expected a solid, found an object; write a call of one, for example sphere(5)
error: whole of sink: expected a whole number from -1000000000 to 1000000000, found the text "Blue"
error: ratio of sink: expected a ratio, found the number 2; write for example "3:2"
error: expected a number, found the colour "colour" of source; write one of its parts: .colour.r
)");
}

TEST_F(Ports, SolidsPassOutputsOnThroughMapsAndUnions) {
  const NodePtr rod = make("rod", {}), moved = make("moved", {{"by", list({20, 0, 0})}}, {rod});
  EXPECT_TRUE(rod->type().is_solid());
  EXPECT_EQ(named_output(rod, "along", {5, 0, 0}), 1);
  EXPECT_EQ(named_output(moved, "along", {25, 0, 0}), 1);
  const NodePtr both = make("joined", {}, {make("sink", {}), moved, rod});
  EXPECT_EQ(named_output(both, "along", {-5, 0, 0}), 0);
  EXPECT_EQ(named_output(both, "along", {20, 0, 0}), 0.5);
  EXPECT_EQ(named_output(both, "place", {22, 0, 0}), 2);
  EXPECT_EQ(both->output_type("place")->name, "vector");
  EXPECT_FALSE(both->output_type("across"));
  EXPECT_EQ(named_output(both, "across", {22, 0, 0}), 0);
}

}  // namespace
}  // namespace ombre::design
