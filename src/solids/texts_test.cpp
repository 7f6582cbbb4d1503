// Tests of texts, against Debian's openscad 2021.01 and the outlines of fonts.
#include "solids/texts.h"
#include "draw/font_search.h"
#include "draw/text_outlines.h"
#include "solids/test_trees.h"

namespace ombre::solids {
namespace {

class ScadTexts : public KernelTest {};

// The expected boxes and areas are from Debian's openscad 2021.01, whose letters differ from the font's outlines by up
// to 0.003 mm here.
TEST_F(ScadTexts, HaveTheBoxesAndAreasOfOpenScad) {
  const auto found = draw::search_font("DejaVu Sans", false, false);
  if (!draw::can_outline_text() || !found || !found->has_name) GTEST_SKIP();
  const auto written = [](const std::string& words, const std::string& across, const std::string& up, double edges) {
    Text text;
    text.text = words;
    text.font = "DejaVu Sans";
    text.horizontal = across;
    text.vertical = up;
    text.fragments.count = edges;
    return *evaluated(node(text)).at(0).region();
  };
  const auto expect_box = [&](const Box& box, double x0, double x1, double y0, double y1) {
    constexpr double grid = 4e-3;
    EXPECT_NEAR(box.lo.x, x0, grid);
    EXPECT_NEAR(box.hi.x, x1, grid);
    EXPECT_NEAR(box.lo.y, y0, grid);
    EXPECT_NEAR(box.hi.y, y1, grid);
  };
  expect_box(bounds_of(written("Hg", "left", "baseline", 0)), 1.36299, 17.7533, -2.8864, 10.1248);
  expect_box(bounds_of(written("Hg", "right", "top", 0)), -17.4456, -1.05527, -12.7739, 0.237289);
  expect_box(bounds_of(written("Hg", "center", "center", 0)), -8.04129, 8.34901, -6.42076, 6.59042);
  EXPECT_NEAR(area_of(written("O", "left", "bottom", 0)), 35.926843, 0.02);
  EXPECT_NEAR(area_of(written("O", "left", "bottom", 100)), 36.136056, 0.02);
  EXPECT_NEAR(area_of(written("O", "left", "bottom", 4)), 35.234009, 0.02);
}

// The box of a text's area is that which measures_of() gives.
// A column of letters is aligned by the widest letter and by the sum of the advances.
TEST_F(ScadTexts, StandUpright) {
  if (!draw::can_outline_text() || !draw::search_font("DejaVu Sans", false, false)) GTEST_SKIP();
  const auto box = [](const std::string& across, const std::string& up) {
    Text text{"HI", 10, "DejaVu Sans", across, up};
    text.direction = "ttb";
    text.spacing = 2;
    return bounds_of(*evaluated(node(text)).at(0).region());
  };
  const Box plain = box("left", "bottom"), middle = box("center", "center"), moved = box("right", "top");
  const double width = 1000.0 / 1024 * (plain.hi.x - plain.lo.x);
  EXPECT_NEAR(moved.lo.x - plain.lo.x, -width, 1e-2);
  EXPECT_NEAR(middle.lo.x - plain.lo.x, -width / 2, 1e-2);
  EXPECT_GT(moved.lo.y, plain.lo.y);
  EXPECT_NEAR(moved.lo.y - plain.lo.y, 2 * (middle.lo.y - plain.lo.y), 1e-6);
}

TEST_F(ScadTexts, AreMeasured) {
  if (!draw::can_outline_text() || !draw::search_font("DejaVu Sans", false, false)) GTEST_SKIP();
  Diagnostics messages;
  for (const char* side : {"left", "center", "right"})
    for (const char* level : {"baseline", "top", "center", "bottom"}) {
      Text text{"Hg", 10, "DejaVu Sans", side, level};
      text.spacing = 1.2;
      const auto measures = measures_of(text, {}, messages);
      ASSERT_TRUE(measures);
      const Box box = bounds_of(region_of_text(text, {}, messages));
      EXPECT_NEAR(measures->low.x, box.lo.x, 0.01);
      EXPECT_NEAR(measures->low.y, box.lo.y, 0.01);
      EXPECT_NEAR(measures->high.x, box.hi.x, 0.01);
      EXPECT_NEAR(measures->high.y, box.hi.y, 0.01);
    }
  EXPECT_TRUE(messages.list().empty());
}

}  // namespace
}  // namespace ombre::solids
