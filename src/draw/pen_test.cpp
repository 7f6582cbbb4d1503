// Tests of the pen: areas covered by shapes, and letters.
#include "draw/pen.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/system/test_source_files.h"
#include "base/text/error.h"

namespace ombre::draw {
namespace {

struct Sheet {
  std::vector<uint8_t> pixels;
  Canvas canvas;
  explicit Sheet(int64_t width, int64_t height, uint8_t fill = 0)
      : pixels(static_cast<size_t>(width * height * 4), fill), canvas{width, height, &pixels} {}
  int alpha(int64_t column, int64_t row) const { return at(column, row, 3); }
  int at(int64_t column, int64_t row, size_t channel) const {
    return pixels[static_cast<size_t>((row * canvas.width + column) * 4) + channel];
  }
  double area() const {
    double sum = 0;
    for (size_t n = 3; n < pixels.size(); n += 4) sum += pixels[n] / 255.0;
    return sum;
  }
};

constexpr Rgb red{255, 0, 0};

class Pens : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_draw()) GTEST_SKIP() << "built without FreeType";
  }
};

}  // namespace

TEST_F(Pens, CoverWhatTheyShould) {
  Pen pen;
  Sheet sheet(20, 10);
  pen.rectangle(sheet.canvas, {2.5, 3}, {7, 6.25}, red);
  EXPECT_EQ(sheet.alpha(4, 4), 255);
  EXPECT_NEAR(sheet.alpha(2, 4), 128, 1);
  EXPECT_NEAR(sheet.alpha(4, 6), 64, 1);
  EXPECT_EQ(sheet.alpha(1, 4), 0);
  EXPECT_EQ(sheet.at(2, 4, 0), 255);  // half covered, but fully red
  EXPECT_NEAR(sheet.area(), 4.5 * 3.25, 0.05);
}

TEST_F(Pens, LinesHaveTheirWidthInAnyDirection) {
  Pen pen;
  for (const Spot to : {Spot{90, 50}, Spot{50, 90}, Spot{20, 23}, Spot{80, 11}}) {
    Sheet sheet(100, 100);
    pen.line(sheet.canvas, {50, 50}, to, 3, red);
    // Corners are rounded to 1/64 of a pixel.
    EXPECT_NEAR(sheet.area() / (3 * std::hypot(to.right - 50, to.down - 50)), 1, 0.01);
  }
}

TEST_F(Pens, LayColoursOver) {
  Pen pen;
  Sheet white(4, 4, 255);
  pen.rectangle(white.canvas, {0, 0}, {4, 1.5}, red);
  EXPECT_EQ(white.at(1, 0, 1), 0);
  EXPECT_NEAR(white.at(1, 1, 1), 128, 1);
  EXPECT_EQ(white.at(1, 1, 3), 255);
  EXPECT_EQ(white.at(1, 2, 1), 255);
}

TEST_F(Pens, CutOffWhatLiesOutside) {
  Pen pen;
  Sheet sheet(10, 10);
  pen.rectangle(sheet.canvas, {-1e6, -50}, {5, 5}, red);
  pen.line(sheet.canvas, {20, -20}, {30, 400}, 2, red);
  pen.write(sheet.canvas, {-40, 3}, "far away to the right and on", 12, red);
  pen.write(sheet.canvas, {2, 500}, "below", 12, red);
  EXPECT_EQ(sheet.alpha(2, 9), 0);
  EXPECT_EQ(sheet.alpha(2, 4), 255);
}

TEST_F(Pens, WriteOnALine) {
  Pen pen;
  Sheet sheet(60, 40);
  pen.write(sheet.canvas, {5, 30}, "HI", 20, red);
  for (int64_t column = 0; column < 60; ++column)
    for (const int64_t row : {3, 31, 35}) EXPECT_EQ(sheet.alpha(column, row), 0);
  EXPECT_GT(sheet.area(), 40);
  const double width = pen.text_width("HI", 20);
  EXPECT_NEAR(pen.text_width("HIHI", 20), 2 * width, 1e-6);
  EXPECT_NEAR(pen.text_width("HI", 40), 2 * width, 0.1);
  Sheet again(60, 40);
  pen.write(again.canvas, {5, 30}, "HI", 20, red);
  EXPECT_EQ(sheet.pixels, again.pixels);
}

TEST_F(Pens, TakeAnyBytesAsText) {
  Pen pen;
  Sheet sheet(100, 20);
  EXPECT_TRUE(pen.has_letters("Größe µm Ω"));
  EXPECT_FALSE(pen.has_letters("\xF0\xB0\x80\x80"));  // no usual font has this ideograph
  for (const char* text : {"\xFF\xFE", "\xC3", "a\xE2\x82", "", "\n\t"})
    pen.write(sheet.canvas, {1, 15}, text, 12, red);
  EXPECT_NEAR(pen.text_width("Ä", 20), pen.text_width("A", 20), 0.01);
}

TEST_F(Pens, SayWhichFontIsWrong) {
  EXPECT_THROW(Pen("/no/such/font.ttf"), Error);
  EXPECT_THROW(Pen(source_file("README.md")), Error);
}

}  // namespace ombre::draw
