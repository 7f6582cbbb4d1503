// Tests of what the pictures of jobs leave open; src/jobs/picture tests what annotations show.
#include "render/annotations.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ombre::render {
namespace {

constexpr int64_t wide = 400, high = 300;

class Labelling : public testing::Test {
 protected:
  void SetUp() override {
    if (!draw::can_draw()) GTEST_SKIP() << "no letters in this build";
    pen.emplace();
  }

  // Returns a picture in the background's colour with these annotations.
  std::vector<uint8_t> annotated(const Annotations& annotations, const Background& background) {
    std::vector<uint8_t> rgba;
    for (int64_t n = 0; n < wide * high; ++n)
      rgba.insert(rgba.end(), background.colour.begin(), background.colour.end());
    const Layout layout = lay_out(wide, high, annotations, *pen);
    annotate({wide, high, &rgba}, layout, annotations, {}, 0.1, background, *pen);
    return rgba;
  }

  std::optional<draw::Pen> pen;
};

bool is_free(const std::vector<uint8_t>& rgba, int64_t column, int64_t row, const Rgba8& colour) {
  return std::equal(colour.begin(), colour.end(), rgba.begin() + 4 * (row * wide + column));
}

}  // namespace

TEST_F(Labelling, TakesNoRoomWithoutAnnotations) {
  for (const int64_t height : {20, 300, 9000}) {
    const Layout layout = lay_out(500, height, {}, *pen);
    EXPECT_EQ(layout.width, 500);
    EXPECT_EQ(layout.height, height);
    EXPECT_GE(layout.text_size, 11);
    EXPECT_LE(layout.text_size, 64);
  }
}

TEST_F(Labelling, NamesNeverTakeMoreThanAThirdOfThePicture) {
  Annotations annotations;
  annotations.legend = {{"red", {255, 0, 0, 255}}};
  const int64_t with_short_name = lay_out(wide, high, annotations, *pen).width;
  EXPECT_LT(with_short_name, wide);
  std::string name;
  for (int n = 0; n < 100; ++n) name += "\u00e4\u20ac";  // letters of two and three bytes
  annotations.legend.push_back({name, {0, 0, 255, 255}});
  const Layout layout = lay_out(wide, high, annotations, *pen);
  EXPECT_LT(layout.width, with_short_name);
  EXPECT_GE(layout.width, wide * 2 / 3);
  // The name is shortened: the margin at the right, as wide as a line of text is high, stays free, and so do the
  // contents.
  const Background white;
  const std::vector<uint8_t> rgba = annotated(annotations, white);
  for (int64_t row = 0; row < high; ++row) {
    for (int64_t column = wide - layout.text_size + 2; column < wide; ++column)
      ASSERT_TRUE(is_free(rgba, column, row, white.colour)) << column << " " << row;
    for (int64_t column = 0; column < layout.width; ++column)
      ASSERT_TRUE(is_free(rgba, column, row, white.colour)) << column << " " << row;
  }
}

TEST_F(Labelling, InkIsSeenOnEveryBackground) {
  Annotations annotations;
  annotations.scale_bar = true;
  for (const auto& [background, is_light] :
       {std::pair(Background{{255, 255, 255, 255}, false}, true), std::pair(Background{{0, 0, 0, 255}, false}, false),
        std::pair(Background{{0, 0, 0, 255}, true}, true), std::pair(Background{{255, 255, 0, 255}, false}, true),
        std::pair(Background{{0, 0, 255, 255}, false}, false)}) {
    const std::vector<uint8_t> rgba = annotated(annotations, background);
    int darkest = 255, lightest = 0;
    for (int64_t n = 0; n < wide * high; ++n) {
      if (is_free(rgba, n % wide, n / wide, background.colour)) continue;
      const int green = rgba[static_cast<size_t>(4 * n + 1)];
      darkest = std::min(darkest, green);
      lightest = std::max(lightest, green);
    }
    if (is_light) {
      EXPECT_LT(darkest, 100);
    } else {
      EXPECT_GT(lightest, 200);
    }
  }
}

TEST_F(Labelling, LegendsThatAreTooLongEndInThePicture) {
  Annotations annotations;
  for (int n = 0; n < 100; ++n) annotations.legend.push_back({"m" + std::to_string(n), {0, 0, 255, 255}});
  const std::vector<uint8_t> rgba = annotated(annotations, {});
  int64_t swatches = 0;
  for (int64_t row = 1; row < high; ++row) {
    const auto has_blue = [&](int64_t of_row) {
      for (int64_t column = 0; column < wide; ++column)
        if (is_free(rgba, column, of_row, {0, 0, 255, 255})) return true;
      return false;
    };
    swatches += has_blue(row) && !has_blue(row - 1) ? 1 : 0;
  }
  // Lines of 11 pixels are 1.6 of these apart, and the last one says how many more there are.
  EXPECT_LE(swatches, high / (1.6 * 11));
  EXPECT_GE(swatches, high / (1.6 * 11) - 3);
}

}  // namespace ombre::render
