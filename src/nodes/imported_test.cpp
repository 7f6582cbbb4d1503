#include <gtest/gtest.h>

#include "nodes/test_solids.h"
#include "nodes/test_sources.h"

namespace ombre::nodes {
namespace {

using namespace design;

// A source with a remark for jobs with small voxels.
class DoubtfulBall : public test::PendingBall {
 public:
  std::vector<Remark> remarks(const std::optional<JobScale>& scale) const override {
    if (!scale || scale->voxel_mm.x > 0.5) return {};
    return {{Severity::warning, "the ball has gaps", "repair it"}};
  }
};

class DoubtfulLoader : public test::BallLoader {
 public:
  PendingSourcePtr pending() const override { return std::make_shared<DoubtfulBall>(); }
};

NodePtr cad_ball() {
  DoubtfulLoader loader;
  Diagnostics diagnostics;
  const NodeType& type = *registry().find("cad");
  const auto& path = type.parameters[static_cast<size_t>(type.parameter("path"))];
  const auto& material = type.parameters[static_cast<size_t>(type.parameter("material"))];
  const NodePtr node = make_node(type, {{&path, Data("ball.step")}, {&material, Data("red")}}, {},
                                 {two_materials(), diagnostics, &loader, {}, "", ""});
  EXPECT_TRUE(node) << to_text(diagnostics);
  return node;
}

Diagnostics remarks_for(const NodePtr& node, Vec3 voxel_mm) {
  LoweringContext context(two_materials(), {node}, voxel_mm);
  program::Builder builder;
  Lowering lowering(context, builder);
  const program::Point p = program::Point::origin_frame(builder);
  lowering.inside(*node, p);
  lowering.distance(*node, p);
  lowering.composition(*node, p, Demand::inside);
  return context.diagnostics();
}

}  // namespace

TEST(CadNode, TellsOnceWhatIsToBeSaidOfItsSource) {
  const NodePtr node = cad_ball();
  ASSERT_TRUE(node);
  EXPECT_TRUE(remarks_for(node, {1, 1, 1}).list().empty());
  Diagnostics all = remarks_for(node, {0.1, 0.1, 0.1});
  ASSERT_EQ(all.list().size(), 1u);
  EXPECT_EQ(all.list()[0].message, "the ball has gaps");
  EXPECT_EQ(all.list()[0].severity, Severity::warning);
  // Lowering the design again gives no new diagnostics.
  all.add_new(remarks_for(node, {0.1, 0.1, 0.1}));
  EXPECT_EQ(all.list().size(), 1u);
  EXPECT_TRUE(all.after(1).list().empty());
}

}  // namespace ombre::nodes
