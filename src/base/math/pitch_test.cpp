// Pitches are exact ratios: an inch is 25.4 mm, so 600 dpi is 25.4/600 = 127/3000 mm.
#include "base/math/pitch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ombre {
namespace {

struct Meaning {
  std::string text;
  int64_t numerator, denominator;
};

void expect_ratio(const std::optional<Pitch>& pitch, const Meaning& meant) {
  ASSERT_TRUE(pitch) << meant.text;
  EXPECT_EQ(pitch->numerator, meant.numerator) << meant.text;
  EXPECT_EQ(pitch->denominator, meant.denominator) << meant.text;
}

}  // namespace

TEST(Pitch, TextIsExact) {
  const Meaning meanings[] = {{"25.4/600", 127, 3000},
                              {"0.027", 27, 1000},
                              {"1/3", 1, 3},
                              {" 1 / 3 ", 1, 3},
                              {"0.1", 1, 10},
                              {".5", 1, 2},
                              {"5.", 5, 1},
                              {"0.40", 2, 5},
                              {"25.4/1200", 127, 6000},
                              {"0.3/0.6", 1, 2},
                              {"1", 1, 1},
                              {"0.00005", 1, 20000},
                              {"5e-1", 1, 2},
                              {"1e-1", 1, 10},
                              {"1E-3", 1, 1000},
                              {"2.54e+1/3e2", 127, 1500},
                              {"0.042333", 42333, 1000000},
                              {"0.0423333", 423333, 10000000},
                              {"0.100000000000", 1, 10}};
  for (const Meaning& meant : meanings) expect_ratio(Pitch::parse(meant.text), meant);
}

TEST(Pitch, DotsPerInchAreExact) {
  const Meaning meanings[] = {{"600", 127, 3000}, {"300", 127, 1500}, {"25.4", 1, 1},
                              {"254", 1, 10},     {"72", 127, 360},   {"1200", 127, 6000}};
  for (const Meaning& meant : meanings) expect_ratio(Pitch::from_dpi(meant.text), meant);
}

TEST(Pitch, MillimetresMeanTheirShortestDecimal) {
  const std::pair<double, Meaning> meanings[] = {{0.07, {"0.07", 7, 100}},       {0.1, {"0.1", 1, 10}},
                                                 {5e-05, {"5e-05", 1, 20000}},   {2.5e-7, {"2.5e-07", 1, 4000000}},
                                                 {0.027, {"0.027", 27, 1000}},   {3, {"3", 3, 1}},
                                                 {0.0375, {"0.0375", 3, 80}},    {1e15, {"1e15", 1000000000000000, 1}},
                                                 {1e-12, {"", 1, 1000000000000}}};
  for (const auto& [mm, meant] : meanings) expect_ratio(Pitch::from_mm(mm), meant);
}

// A program wrote these quotients in double precision or with fewer digits.
TEST(Pitch, ComputedTextIsTheRatioThatWasMeant) {
  const Meaning meanings[] = {{"0.08466666666666667", 127, 1500},  {"0.0846666666666667", 127, 1500},
                              {"0.084666666667", 127, 1500},       {"0.042333333", 127, 3000},
                              {"0.3333333333333333", 1, 3},        {"0.333333333333", 1, 3},
                              {"0.30000000000000004", 3, 10},      {"0.6666666666666666/2", 1, 3},
                              {"8.466666666666667e-2", 127, 1500}, {"0.1000000000000000055511151231257827", 1, 10},
                              {"0.12345678", 6172839, 50000000},   {"299.99999999999994", 300, 1}};
  for (const Meaning& meant : meanings) expect_ratio(Pitch::parse(meant.text), meant);
  expect_ratio(Pitch::from_dpi("300.00000000000006"), {"300.00000000000006", 127, 1500});
}

TEST(Pitch, ComputedMillimetresAreTheRatioThatWasMeant) {
  for (int dpi = 1; dpi <= 12000; ++dpi) {
    const auto exact = Pitch::from_dpi(std::to_string(dpi));
    EXPECT_EQ(Pitch::from_mm(25.4 / dpi), exact) << dpi;
    EXPECT_EQ(Pitch::from_mm(1 / (dpi / 25.4)), exact) << dpi;
  }
  for (int64_t n = 1; n <= 60; ++n)
    for (int64_t d = 1; d <= 60; ++d)
      EXPECT_EQ(Pitch::from_mm(static_cast<double>(n) / static_cast<double>(d)), Pitch::from_ratio(n, d));
}

// A number that is not a simple ratio keeps its value.
TEST(Pitch, AnyMillimetresAreKept) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-4, 4);
  for (int i = 0; i < 20000; ++i) {
    const double mm = std::exp(2.3 * exponent(random));
    const auto pitch = Pitch::from_mm(mm);
    ASSERT_TRUE(pitch) << mm;
    EXPECT_NEAR(pitch->mm(), mm, 1e-13 * mm);
    EXPECT_EQ(Pitch::parse(pitch->text()), pitch);
  }
}

TEST(Pitch, RefusesWhatIsNoLength) {
  for (const char* text : {"",
                           " ",
                           ".",
                           "/",
                           "1/",
                           "/3",
                           "1/0",
                           "0",
                           "0.0",
                           "0/5",
                           "-1",
                           "-0.1",
                           "+1",
                           "1e",
                           "1e-",
                           "1e-3.5",
                           "e-3",
                           "1e-30",
                           "1e300",
                           "1e999",
                           "-1e-3",
                           "1/2/3",
                           "0,1",
                           "1.2.3",
                           "abc",
                           "0x10",
                           "1 2",
                           "inf",
                           "nan",
                           "99999999999999999999",
                           "0.00000000000000000001",
                           "4000000000000000/0.001",
                           "1\n2"})
    EXPECT_FALSE(Pitch::parse(text)) << text;
  for (const char* text : {"", "0", "-600", "600dpi", "6e", "99999999999999999999"})
    EXPECT_FALSE(Pitch::from_dpi(text)) << text;
  for (const double mm : {0.0, -0.0, -0.1, 1e300, 1e-300, 5e-324, HUGE_VAL, -HUGE_VAL, std::nan("")})
    EXPECT_FALSE(Pitch::from_mm(mm)) << mm;
  EXPECT_FALSE(Pitch::from_ratio(0, 1));
  EXPECT_FALSE(Pitch::from_ratio(1, 0));
  EXPECT_FALSE(Pitch::from_ratio(-1, -3));
  EXPECT_FALSE(Pitch::from_ratio((int64_t{1} << 53) + 1, 2));
}

TEST(Pitch, TextReadsBack) {
  for (const auto& [numerator, denominator, text] : {std::tuple{int64_t{127}, int64_t{3000}, "127/3000"},
                                                     {27, 1000, "0.027"},
                                                     {1, 3, "1/3"},
                                                     {1, 10, "0.1"},
                                                     {7, 1, "7"}})
    EXPECT_EQ(Pitch::from_ratio(numerator, denominator)->text(), text);

  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    // The terms cover all magnitudes alike.
    const auto term = [&] { return static_cast<int64_t>(1 + (random() >> (13 + random() % 50))); };
    const auto pitch = Pitch::from_ratio(term(), term());
    if (!pitch) continue;
    EXPECT_EQ(Pitch::parse(pitch->text()), pitch) << pitch->text();
  }
  EXPECT_EQ(Pitch::parse(Pitch::from_mm(5e-05)->text()), Pitch::from_mm(5e-05));
  EXPECT_EQ(Pitch::parse(Pitch::from_mm(1e15)->text()), Pitch::from_mm(1e15));
}

TEST(Pitch, LargeIndicesAreRoundedOnce) {
  const Pitch pitch = *Pitch::from_dpi("600");
  // 11575 voxels of 127/3000 mm make 1470025/3000 = 490 + 25/3000 mm. A product with 0.0423 would be off by 0.4 mm.
  EXPECT_EQ(pitch.times(11575), 1470025.0 / 3000.0);
  // Each 3000 voxels make exactly 127 mm.
  for (int n = 0; n < 5000; ++n) EXPECT_EQ(pitch.times(3000.0 * n), 127.0 * n);
  // The centre (i + 1/2) p, rounded once, equals the long double quotient rounded a second time, which may differ only
  // on ties.
  for (int i = 0; i < 20000; ++i)
    EXPECT_EQ(pitch.times(i + 0.5), static_cast<double>((i + 0.5L) * 127.0L / 3000.0L)) << i;
  EXPECT_EQ(pitch.mm(), 127.0 / 3000.0);
}

TEST(Pitch, DotsPerMetre) {
  // 600 dots per 0.0254 m are 23622.047... per metre.
  EXPECT_DOUBLE_EQ(Pitch::from_dpi("600")->dots_per_metre(), 600 / 0.0254);
  EXPECT_EQ(Pitch::from_mm(0.1)->dots_per_metre(), 10000);
}

}  // namespace ombre
