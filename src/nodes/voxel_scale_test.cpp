// Tests of the size of a job's voxels in the space of a node.
#include <gtest/gtest.h>

#include "base/text/json.h"
#include "design/lowering.h"
#include "nodes/all_nodes.h"

namespace ombre::nodes {
namespace {

using namespace design;

class VoxelScale : public testing::Test {
 protected:
  VoxelScale() {
    Diagnostics diagnostics;
    const auto data =
        parse_json(make_source("m", R"({"materials": [{"name": "red", "r": 255, "g": 0, "b": 0}]})"), diagnostics);
    materials_ = *MaterialTable::read(*data, diagnostics);
  }

  NodePtr make(const std::string& name, const std::vector<std::pair<std::string, Data>>& values,
               std::vector<NodePtr> inputs) {
    const NodeType& type = *registry().find(name);
    std::vector<NamedValue> named;
    for (const auto& [parameter, value] : values)
      named.push_back({&type.parameters[static_cast<size_t>(type.parameter(parameter))], value});
    Diagnostics diagnostics;
    const NodePtr node = make_node(type, named, std::move(inputs), {materials_, diagnostics, nullptr, {}, "", ""});
    EXPECT_TRUE(node) << to_text(diagnostics);
    return node;
  }
  NodePtr sphere() { return make("sphere", {{"radius", Data(1.0)}}, {}); }
  NodePtr scaled(double x, double y, double z, const NodePtr& input) {
    return make("scale", {{"by", Data(DataList{Data(x), Data(y), Data(z)})}}, {input});
  }
  NodePtr moved(const NodePtr& input) {
    return make("translate", {{"by", Data(DataList{Data(1.0), Data(2.0), Data(3.0)})}}, {input});
  }

  Vec3 voxel(const NodePtr& root, const NodePtr& node) {
    return LoweringContext(materials_, {root}, Vec3{1, 2, 4}).scale(*node)->voxel_mm;
  }

  MaterialTable materials_;
};

void expect_near(Vec3 found, Vec3 wanted) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], wanted[axis], 1e-12);
}

}  // namespace

TEST_F(VoxelScale, FollowsTransforms) {
  const NodePtr ball = sphere();
  expect_near(voxel(ball, ball), {1, 2, 4});
  expect_near(voxel(moved(ball), ball), {1, 2, 4});
  expect_near(voxel(moved(scaled(10, 10, 10, moved(ball))), ball), {0.1, 0.2, 0.4});
  expect_near(voxel(scaled(0.5, 0.5, 0.5, scaled(10, 10, 10, ball)), ball), {0.2, 0.4, 0.8});
  // Where a part is stretched in one direction, the finest size counts.
  expect_near(voxel(scaled(1, 1, 4, ball), ball), {0.25, 0.5, 1});
}

TEST_F(VoxelScale, IsTheLeastOfSeveralWays) {
  const NodePtr ball = sphere();
  const NodePtr both = make("union", {}, {scaled(2, 2, 2, ball), moved(ball), scaled(5, 5, 5, ball)});
  expect_near(voxel(both, ball), {0.2, 0.4, 0.8});
}

TEST_F(VoxelScale, HoldsForTrianglesToo) {
  const NodePtr ball = sphere(), large = scaled(10, 10, 10, ball);
  EXPECT_NEAR(LoweringContext(materials_, {large}, Vec3{1, 2, 4}).scale(*ball)->triangles_mm, 0.025, 1e-12);
  EXPECT_NEAR(LoweringContext(materials_, {large}, JobScale({1, 2, 4}, 0.3)).scale(*ball)->triangles_mm, 0.03, 1e-12);
}

TEST_F(VoxelScale, IsUnknownWithoutAJob) {
  const NodePtr ball = sphere();
  EXPECT_FALSE(LoweringContext(materials_, {ball}).scale(*ball));
}

}  // namespace ombre::nodes
