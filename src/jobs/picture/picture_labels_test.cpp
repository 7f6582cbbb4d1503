// Tests axes, scale bars and legends of pictures by their pixels.
#include "jobs/picture/picture_labels.h"

#include <cmath>

#include "base/math/round_numbers.h"
#include "jobs/test_pictures.h"
#include "questions/colour_map.h"

namespace ombre::compile {
namespace {

constexpr int64_t width = 400, height = 300;

class Labels : public testing::Test {
 protected:
  void SetUp() override {
    if (!draw::can_draw()) GTEST_SKIP() << "built without FreeType";
  }

  std::optional<Picture> take(const std::string& text, PictureRequest request) {
    if (request.width == 800) {
      request.width = width;
      request.height = height;
    }
    return picture_of(text, request, diagnostics);
  }

  Diagnostics diagnostics;
};

struct Pixel {
  int red, green, blue;
  bool is_ink() const { return red < 100 && green < 100 && blue < 100; }
  bool is_white() const { return red == 255 && green == 255 && blue == 255; }
};

Pixel at(const Picture& picture, int64_t column, int64_t row) {
  const uint8_t* p = picture.rgba.data() + (row * width + column) * 4;
  return {p[0], p[1], p[2]};
}

std::string balls(int count) {
  std::string text = "union() {";
  static const char* names[] = {"red", "green", "blue", "gray", "white", "black", "cyan", "magenta", "yellow", "pink"};
  for (int n = 0; n < count; ++n)
    text += "translate(" + std::to_string(3 * n) + ", 0, 0) sphere(1, \"" + names[n] + "\");";
  return text + "}";
}

}  // namespace

TEST_F(Labels, ScaleBarsAreAsLongAsTheySay) {
  PictureRequest request;
  request.annotations.scale_bar = true;
  for (const double radius : {0.3, 4.0, 77.0}) {
    const auto picture = take("sphere(" + std::to_string(radius) + ", \"red\");", request);
    ASSERT_TRUE(picture);
    // The bar is the longest run of ink.
    int64_t longest = 0;
    for (int64_t row = 0; row < height; ++row)
      for (int64_t column = 0, run = 0; column < width; ++column) {
        run = at(*picture, column, row).is_ink() ? run + 1 : 0;
        longest = std::max(longest, run);
      }
    const double length = math::greatest_round(0.3 * width * picture->pixel_mm);
    EXPECT_NEAR(static_cast<double>(longest) * picture->pixel_mm, length, 1.01 * picture->pixel_mm) << radius;
  }
}

// From the front, x goes to the right and z up, and y is seen from its end.
TEST_F(Labels, AxesPointWhereTheDesignDoes) {
  PictureRequest request;
  request.annotations.axes = true;
  request.view = *render::named_view("front");
  const auto picture = take("sphere(5, \"gray\");", request);
  ASSERT_TRUE(picture);
  const int64_t unit = 11, left = 3 * unit, down = height - 3 * unit;
  const Pixel x = at(*picture, left + unit, down), z = at(*picture, left, down - unit);
  EXPECT_GT(x.red, x.blue + 40);
  EXPECT_GT(z.blue, z.red + 40);
  EXPECT_TRUE(at(*picture, left + unit, down - unit).is_white());
  EXPECT_TRUE(at(*picture, left - 2 * unit, down).is_white());
  EXPECT_TRUE(at(*picture, left, down + 2 * unit).is_white());
}

TEST_F(Labels, LegendsHaveTheColours) {
  PictureRequest request;
  request.annotations.legend = true;
  const auto picture = take("union() { sphere(5, \"blue\"); translate(9, 0, 0) sphere(5, \"green\"); }", request);
  ASSERT_TRUE(picture);
  std::vector<Pixel> swatches;  // swatches on the right, in rows of 1.6 lines
  for (const int64_t row : {16, 34}) {
    for (int64_t column = width - 1; column > 0; --column) {
      const Pixel p = at(*picture, column, row);
      if (std::abs(p.green - p.red) < 60 && std::abs(p.blue - p.red) < 60) continue;
      swatches.push_back(p);
      break;
    }
  }
  ASSERT_EQ(swatches.size(), 2U);
  EXPECT_EQ(swatches[0].green, 160);  // in the order of the file of materials
  EXPECT_EQ(swatches[1].blue, 255);
}

// The bar goes from the last colour on top to the first below, without steps.
TEST_F(Labels, ValuesHaveABarOfTheirColours) {
  PictureRequest request;
  request.by = "density";
  request.annotations.legend = true;
  const auto picture = take("attribute(\"density\", \"1 + x/20\") sphere(5);", request);
  ASSERT_TRUE(picture);
  const auto matches = [&](Pixel p, design::Rgba c) { return p.red == c[0] && p.green == c[1] && p.blue == c[2]; };
  int64_t bar = 0, first = 0, last = 0;
  for (int64_t column = width - 1; column > width / 2 && bar == 0; --column)
    for (int64_t line = 0; line < height; ++line)
      if (matches(at(*picture, column, line), map_colour(511.0 / 512))) bar = column;
  ASSERT_GT(bar, 0);
  for (int64_t line = height - 1; line >= 0; --line) {
    if (matches(at(*picture, bar, line), map_colour(511.0 / 512))) first = line;
    if (last == 0 && matches(at(*picture, bar, line), map_colour(1.0 / 512))) last = line;
  }
  ASSERT_GT(last, first + 60);
  for (int64_t line = first; line < last; ++line) {
    const double share = 1 - (static_cast<double>(line - first) + 0.5) / static_cast<double>(last - first + 1);
    const design::Rgba expected = map_colour(share);
    EXPECT_NEAR(at(*picture, bar, line).green, expected[1], 4) << line;
  }
}

// Three balls in a row, seen from the front, each have a colour of their own, a name in the middle and dark rims.
TEST_F(Labels, PartsHaveColoursOutlinesAndNames) {
  PictureRequest request;
  request.view = *render::named_view("front");
  request.by = "parts";
  request.overlays.outlines = Divided::parts;
  const std::string row =
      "part(\"one\") sphere(5); union() { translate(12, 0, 0) part(\"two\") sphere(5); translate(24, 0, 0) sphere(5); "
      "}";
  const auto plain = take(row, request);
  request.overlays.names = Divided::parts;
  const auto named = take(row, request);
  ASSERT_TRUE(plain && named) << to_text(diagnostics);
  const auto column_of = [&](double x) { return width / 2 + std::lround((x - 12) / plain->pixel_mm); };
  // Solids in no named part at the top level come first, so "two" is 1.
  const Pixel two = at(*plain, column_of(12), height / 2), one = at(*plain, column_of(0), height / 2);
  const Pixel rest = at(*plain, column_of(24), height / 2);
  EXPECT_GT(two.blue, two.red + 60);
  EXPECT_GT(one.red, one.blue + 60);
  EXPECT_LT(std::abs(rest.red - rest.blue), 10);
  for (const double x : {-5.0, 7.0, 19.0}) EXPECT_TRUE(at(*plain, column_of(x), height / 2).is_ink()) << x;
  const auto ink_near = [&](const Picture& picture, double x) {
    int count = 0;
    for (int64_t row_of = height / 2 - 8; row_of < height / 2 + 8; ++row_of)
      for (int64_t column = column_of(x) - 12; column < column_of(x) + 12; ++column)
        count += at(picture, column, row_of).is_ink();
    return count;
  };
  for (const double x : {0.0, 12.0}) EXPECT_GT(ink_near(*named, x), ink_near(*plain, x) + 10) << x;
  EXPECT_EQ(ink_near(*named, 24), ink_near(*plain, 24));
}

TEST_F(Labels, PartsWithoutNamesAreAnError) {
  PictureRequest request;
  request.overlays.names = Divided::parts;
  EXPECT_FALSE(take("sphere(5);", request));
  EXPECT_NE(to_text(diagnostics).find("no part of the design has a name"), std::string::npos) << to_text(diagnostics);
}

TEST_F(Labels, MakeRoomForThemselves) {
  PictureRequest request;
  const auto plain = take(balls(3), request);
  request.annotations = {true, true, true, ""};
  const auto labelled = take(balls(3), request);
  ASSERT_TRUE(plain && labelled);
  EXPECT_GT(labelled->pixel_mm, plain->pixel_mm);
  EXPECT_EQ(plain->rgba.size(), labelled->rgba.size());
}

TEST_F(Labels, FitIntoSmallPicturesOrSaySo) {
  PictureRequest request;
  request.width = 120;
  request.height = 90;
  request.annotations.legend = true;
  EXPECT_TRUE(take(balls(10), request));
  request.width = request.height = 1;
  EXPECT_FALSE(take(balls(10), request));
  EXPECT_NE(to_text(diagnostics).find("the picture is too small"), std::string::npos) << to_text(diagnostics);
}

}  // namespace ombre::compile
