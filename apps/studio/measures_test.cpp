// Tests volumes of materials, and comparisons of versions.
#include "base/text/json.h"
#include "studio/test_studio.h"

namespace ombre::studio {
namespace {

// A cube of 8 mm grows to 10 along x, loses 1 along z, and half of the rest (x < 4) gets another material.

// A mixture changes from half red to three quarters red, so a quarter of it has another material.

TEST_F(StudioTest, MeasuresABall) {
  const Data measured = ask("measure", R"("design": ")" + load(ball) + '"').first;
  const double volume = 4.0 / 3 * 3.14159265358979 * 27;
  EXPECT_NEAR(number_in(measured, "volume_mm3"), volume, 1e-3 * volume);
  ASSERT_EQ(measured.find("materials")->list()->size(), 2U);
  for (const Data& material : *measured.find("materials")->list())  // by symmetry
    EXPECT_NEAR(number_in(material, "volume_mm3"), volume / 2, 1e-3 * volume);
}

TEST_F(StudioTest, MeasuresNamedParts) {
  const Data measured = ask("measure", R"("design": ")" +
                                           load("part(\"arm\") rectprism((8, 8, 8), red);\n"
                                                "part(\"foot\") translate(10, 0, 0) rectprism((4, 8, 8), blue);\n"
                                                "translate(-8, 0, 0) rectprism((2, 8, 8), red);") +
                                           '"')
                            .first;
  const DataList* parts = measured.find("parts")->list();
  ASSERT_TRUE(parts && parts->size() == 3U) << print_json(measured);
  const std::vector<std::pair<std::string, double>> wanted{{"rest", 128}, {"arm", 512}, {"foot", 256}};
  for (size_t n = 0; n < wanted.size(); ++n) {
    EXPECT_EQ(text((*parts)[n], "name"), wanted[n].first);
    EXPECT_NEAR(number_in((*parts)[n], "volume_mm3"), wanted[n].second, 0.05 * wanted[n].second) << wanted[n].first;
  }
  EXPECT_FALSE(ask("measure", R"("design": ")" + load(ball) + '"').first.find("parts"));
}

TEST_F(StudioTest, ComparesTwoVersions) {
  const std::string before = load("translate(4, 4, 4) rectprism((8, 8, 8), red);");
  const std::string after = load(
      "translate(2, 4, 3.5) rectprism((4, 8, 7), blue);\n"
      "translate(7, 4, 3.5) rectprism((6, 8, 7), red);");
  const auto compare = [&](const std::string& old, const std::string& now) {
    return ask("compare", R"("before": ")" + old + R"(", "design": ")" + now + '"').first;
  };
  const Data found = compare(before, after);
  const double within = 0.02 * 448;  // half a voxel of 0.086 mm at a face
  EXPECT_NEAR(number_in(found, "gained_mm3"), 2 * 8 * 7, within) << print_json(found);
  EXPECT_NEAR(number_in(found, "lost_mm3"), 8 * 8 * 1, within);
  EXPECT_NEAR(number_in(found, "changed_mm3"), 4 * 8 * 7, within);
  EXPECT_NEAR(number_in(found, "unchanged_mm3"), 4 * 8 * 7, within);
  const Data back = compare(after, before);
  EXPECT_EQ(number_in(back, "lost_mm3"), number_in(found, "gained_mm3"));
  EXPECT_EQ(number_in(back, "gained_mm3"), number_in(found, "lost_mm3"));
  EXPECT_EQ(number_in(back, "changed_mm3"), number_in(found, "changed_mm3"));
  const Data same = compare(after, after);
  EXPECT_EQ(number_in(same, "gained_mm3") + number_in(same, "lost_mm3") + number_in(same, "changed_mm3"), 0);
  EXPECT_EQ(text(compare("d99", after), "error"), "gone");
}

TEST_F(StudioTest, ComparesMixtures) {
  const auto mixed = [&](const std::string& red) {
    return load("fgrade([\"" + red + "\", \"1 - " + red + "\"], [red, blue]) rectprism((8, 8, 8));");
  };
  const std::string before = mixed("0.5"), after = mixed("0.75");
  const Data found = ask("compare", R"("before": ")" + before + R"(", "design": ")" + after + '"').first;
  EXPECT_NEAR(number_in(found, "changed_mm3"), 128, 3) << print_json(found);
  EXPECT_NEAR(number_in(found, "unchanged_mm3"), 384, 8);
  EXPECT_NEAR(number_in(found, "gained_mm3") + number_in(found, "lost_mm3"), 0, 1e-3);
}

}  // namespace
}  // namespace ombre::studio
