#include "load/turned.h"

#include <gtest/gtest.h>

#include "base/text/json.h"
#include "design/design.h"
#include "load/load.h"
#include "questions/build.h"

namespace ombre::compile {
namespace {

LoadedPtr load(const std::string& text) {
  Diagnostics diagnostics;
  auto loaded = load_text(text, "part.vcad", {}, diagnostics);
  EXPECT_TRUE(loaded) << (diagnostics.list().empty() ? "" : diagnostics.list().front().message);
  return loaded;
}

// A box from 0 to 1, 2 and 3 is turned about x by 90 degrees (y becomes z), and then about z (x becomes y).
TEST(Turned, TurnsAboutXFirst) {
  Diagnostics diagnostics;
  const auto part = load("translate(0.5, 1, 1.5) rectprism((1, 2, 3), red);");
  const auto turned_part = turned(part, {90, 0, 90}, diagnostics);
  ASSERT_TRUE(turned_part);
  const auto box = design_box(turned_part->design, diagnostics);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->lo, (Vec3{0, 0, 0}));
  EXPECT_EQ(box->hi, (Vec3{3, 1, 2}));
}

TEST(Turned, IsWhatTheScriptWouldSay) {
  Diagnostics diagnostics;
  const auto turned_part = turned(load("cone(5, 10);"), {30, -20, 45}, diagnostics);
  const auto written = load("rotate((30, -20, 45), order=\"xyz\") cone(5, 10);");
  ASSERT_TRUE(turned_part);
  EXPECT_EQ(design::hash(turned_part->design), design::hash(written->design));
}

TEST(Turned, LeavesADesignThatIsNotTurned) {
  Diagnostics diagnostics;
  const auto part = load("sphere(3);");
  EXPECT_EQ(turned(part, {0, 0, 0}, diagnostics), part);
}

TEST(Turned, TurnsTheBoxThatIsSampled) {
  Diagnostics diagnostics;
  const auto part = load("root((0, 0, 0), (4, 2, 1), (0.1, 0.1, 0.1)) sphere(9);");
  const auto turned_part = turned(part, {0, 90, 0}, diagnostics);
  ASSERT_TRUE(turned_part);
  EXPECT_EQ(turned_part->design.sampling->box.lo, (Vec3{0, 0, -4}));
  EXPECT_EQ(turned_part->design.sampling->box.hi, (Vec3{1, 2, 0}));
}

}  // namespace
}  // namespace ombre::compile
