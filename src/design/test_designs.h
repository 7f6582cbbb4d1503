// A fixture that makes nodes by their names and evaluates them at points.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/text/json.h"
#include "design/design.h"
#include "design/lowering.h"
#include "design/spec.h"
#include "program/evaluate.h"
#include "program/passes/passes.h"

namespace ombre::design::test {

// Returns the registry of these nodes alone.
template <class... Nodes>
const Registry& registry_of() {
  static const Registry nodes = [] {
    Registry registry;
    registry.add<Nodes...>("test");
    return registry;
  }();
  return nodes;
}

class DesignTest : public testing::Test {
 protected:
  // The materials are the members of a list in JSON.
  DesignTest(const Registry& registry, const std::string& materials, SourceLoader* loader = nullptr)
      : registry_(registry), loader_(loader) {
    Diagnostics diagnostics;
    const auto data = parse_json(make_source("m", R"({"materials": [)" + materials + "]}"), diagnostics);
    materials_ = *MaterialTable::read(*data, diagnostics);
  }

  using Named = std::vector<std::pair<std::string, Data>>;
  // Returns null and adds diagnostics if something is wrong.
  NodePtr try_make(const std::string& type, const Named& values, std::vector<NodePtr> inputs = {}) {
    const NodeType& t = *registry_.find(type);
    std::vector<NamedValue> named;
    for (const auto& [name, data] : values) {
      EXPECT_GE(t.parameter(name), 0) << name;
      named.push_back({&t.parameters[static_cast<size_t>(t.parameter(name))], data});
    }
    return make_node(t, named, std::move(inputs), {materials_, diagnostics_, loader_, {}, "", ""});
  }
  NodePtr make(const std::string& type, const Named& values, std::vector<NodePtr> inputs = {}) {
    NodePtr node = try_make(type, values, std::move(inputs));
    EXPECT_TRUE(node) << to_text(diagnostics_);
    return node;
  }

  static Data object(const NodePtr& node) { return Data(HostObjectPtr(std::make_shared<NodeObject>(node))); }
  // Returns data that gives a node's output to a parameter.
  static Data output(const NodePtr& node, const std::string& name) {
    return Data(DataMembers{{"from", object(node)}, {"output", Data(name)}});
  }
  static Data list(std::initializer_list<double> numbers) {
    DataList data;
    for (const double number : numbers) data.emplace_back(number);
    return Data(std::move(data));
  }

  // Returns the values at p of the fields that `ask` returns, and the number of bodies that they call.
  template <class AskFor>
  std::vector<double> values(const NodePtr& node, Vec3 p, const AskFor& ask, size_t* bodies = nullptr) {
    LoweringContext context(materials_, {node});
    program::Builder builder;
    Lowering lowering(context, builder);
    std::vector<std::pair<std::string, Field>> outputs;
    for (const Field field : ask(lowering, Point::origin_frame(builder))) outputs.emplace_back("v", field);
    context.finish_bodies();
    const program::Program called = builder.finish(outputs);
    if (bodies) *bodies = called.calls.size();
    const program::Program program = program::inline_bodies(called);
    std::vector<double> all, result;
    evaluate_point(program, p, all);
    for (const auto id : program.outputs) result.push_back(all[id]);
    return result;
  }
  std::vector<double> of_output(const NodePtr& node, const std::string& name, Vec3 p) {
    const auto number = node->type().output(name);
    EXPECT_TRUE(number) << name;
    return values(node, p,
                  [&](Lowering& lowering, const Point& at) { return fields_of(lowering.answer(*node, *number, at)); });
  }
  double distance(const NodePtr& node, Vec3 p, size_t* bodies = nullptr) {
    const auto ask = [&](Lowering& lowering, const Point& at) { return std::vector{lowering.distance(*node, at)}; };
    return values(node, p, ask, bodies)[0];
  }

  Data json_of(const NodePtr& node) const { return to_data({materials_, {{"part", node}}, std::nullopt}); }

  const Registry& registry_;
  SourceLoader* loader_;
  MaterialTable materials_;
  Diagnostics diagnostics_;
};

inline constexpr const char* red_and_blue =
    R"({"name": "Red", "r": 1, "g": 2, "b": 3}, {"name": "Blue", "r": 3, "g": 2, "b": 1})";

// Moves its child.
struct Moved {
  Vec3 by;
  static Spec<Moved> spec() { return {"moved", "Moved.", {{"by", &Moved::by, ""}}, one_solid, ""}; }
  Point inner(const Point& p) const { return p.mapped(Affine::translation(-by)); }
  double scale() const { return 1; }
  Box reach(const Inputs& in, const Box& where, double margin) const {
    const Affine map = Affine::translation(by);
    return image(map, in.reach(0, image(inverse(map), where), margin));
  }
};

struct Joined {
  static Spec<Joined> spec() { return {"joined", "Union.", {}, many_solids, ""}; }
  Box reach(const Inputs& in, const Box& where, double margin) const {
    Box box;
    for (size_t i = 0; i < in.count(); ++i) box = hull(box, in.reach(i, where, margin));
    return box;
  }
  Field distance(const Inputs& in, const Point& p) const { return program::fold(in.distances(p), program::min); }
};

}  // namespace ombre::design::test
