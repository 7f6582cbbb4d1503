#include "sources/cad_remarks.h"

#include <gtest/gtest.h>

namespace ombre::sources {

TEST(CadRemarks, SayWhereTrianglesAreOpenAndWhatToDo) {
  std::vector<importing::OpenSolid> open{{"lid", {14, {Vec3{3, 0, 2}, Vec3{3, 0.5, 2}}, 0.02}}};
  const design::Remark one = remark_on_gaps("case.step", open, 0.025, false);
  EXPECT_EQ(one.severity, Severity::warning);
  EXPECT_EQ(
      one.message,
      "the triangles of the CAD file \"case.step\", of its solid \"lid\", are open along 14 edges, for example "
      "from (3, 0, 2) to (3, 0.5, 2), by up to about 0.02 mm; what is inside near the gaps is a guess, by winding "
      "number");
  EXPECT_EQ(one.hint.text(), "repair the file where it was drawn, or write a tolerance below 0.025, or mode=\"exact\"");

  open = {{"", {1, {Vec3{}, Vec3{1, 0, 0}}}}, {"", {2, {Vec3{}, Vec3{0, 1, 0}}}}};
  const design::Remark two = remark_on_gaps("case.step", open, 0.025, true);
  EXPECT_EQ(
      two.message,
      "the triangles of the CAD file \"case.step\" are open along 1 edge, for example from (0, 0, 0) to (1, 0, 0), "
      "and so are those of 1 other; what is inside near the gaps is a guess, by winding number");
  EXPECT_EQ(two.hint.text(), "repair the file where it was drawn");
}

TEST(CadRemarks, SayHowLongExactPartsTake) {
  const design::Remark remark = remark_on_time("engine.step", 1204381, 210, 0.01);
  EXPECT_EQ(remark.severity, Severity::note);
  EXPECT_EQ(
      remark.message,
      "mode=\"exact\" of the CAD file \"engine.step\" will take about 3.5 min on all cores, longer where distances "
      "are needed: its surfaces are evaluated at 1,204,381 voxels");
  EXPECT_EQ(remark.hint.text(), "where triangles will do, write mode=\"fast\" with tolerance=0.01");
}

}  // namespace ombre::sources
