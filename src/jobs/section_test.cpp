// Tests sections seen flat, against geometry.
#include <cmath>

#include "base/system/test_source_files.h"
#include "jobs/test_pictures.h"

namespace ombre::compile {
namespace {

Picture slice(const std::string& text, SliceView plane, PictureRequest request = {}) {
  request.width = request.height = 200;
  request.slice = plane;
  return picture_of(text, request);
}

render::Rgba8 dot(const Picture& picture, int64_t column, int64_t row) {
  render::Rgba8 colour;
  std::copy_n(picture.rgba.begin() + (row * 200 + column) * 4, 4, colour.begin());
  return colour;
}

constexpr render::Rgba8 white{255, 255, 255, 255}, red{255, 0, 0, 255}, blue{0, 80, 255, 255};

}  // namespace

TEST(Sections, OfASphereAreDiscs) {
  PictureRequest request;
  request.background.is_transparent = true;
  for (int axis = 0; axis < 3; ++axis) {
    const Picture picture = slice("sphere(10, \"red\");", {axis, 6}, request);
    double area = 0;
    for (size_t n = 3; n < picture.rgba.size(); n += 4) area += picture.rgba[n] / 255.0;
    const double pi = 3.14159265358979;
    EXPECT_NEAR(area * picture.pixel_mm * picture.pixel_mm / (pi * (100 - 36)), 1, 0.002);
    EXPECT_EQ(dot(picture, 100, 100), red);  // no light falls on it
    EXPECT_EQ(dot(picture, 2, 2)[3], 0);
  }
}

// x or y goes to the right, y or z upwards.
TEST(Sections, LieAsTheDesignDoes) {
  const std::string design =
      R"(union() { cube(10, "red"); translate(8, 0, 3) cube(4, "blue"); translate(0, -8, 0) cube(4, "blue");
    translate(0, 0, 8) cube(4, "blue"); })";
  const auto pixel = [](const Picture& picture, double right, double up, double middle_right, double middle_up) {
    const auto index = [&](double mm) { return static_cast<int64_t>(std::floor(100 + mm / picture.pixel_mm)); };
    return dot(picture, index(right - middle_right), index(middle_up - up));
  };
  // The design lies in x from -5 to 10, y from -10 to 5, z from -5 to 10.
  const Picture z = slice(design, {2, 1.5}), y = slice(design, {1, 0.5}), x = slice(design, {0, 0.5});
  EXPECT_EQ(pixel(z, 8, 0, 2.5, -2.5), blue);
  EXPECT_EQ(pixel(z, 0, -8, 2.5, -2.5), blue);
  EXPECT_EQ(pixel(z, 0, 0, 2.5, -2.5), red);
  EXPECT_EQ(pixel(z, 8, -8, 2.5, -2.5), white);
  EXPECT_EQ(pixel(y, 8, 3, 2.5, 2.5), blue);
  EXPECT_EQ(pixel(y, 0, 8, 2.5, 2.5), blue);
  EXPECT_EQ(pixel(y, 8, 8, 2.5, 2.5), white);
  EXPECT_EQ(pixel(x, -8, 0, -2.5, 2.5), blue);
  EXPECT_EQ(pixel(x, 0, 8, -2.5, 2.5), blue);
  EXPECT_EQ(pixel(x, -8, 8, -2.5, 2.5), white);
}

TEST(Sections, MixColoursByFraction) {
  const Picture picture = slice("fgrade([\"x/20 + 0.5\", \"0.5 - x/20\"], [\"red\", \"blue\"]) cube(20);", {2, 0});
  for (const int64_t column : {20, 60, 100, 140, 180}) {
    const double x = (static_cast<double>(column) + 0.5 - 100) * picture.pixel_mm, share = x / 20 + 0.5;
    const double linear_red = share;  // red has 1 of it, blue none
    const double srgb = linear_red <= 0.0031308 ? 12.92 * linear_red : 1.055 * std::pow(linear_red, 1 / 2.4) - 0.055;
    EXPECT_NEAR(dot(picture, column, 100)[0], 255 * srgb, 1) << column;
  }
}

TEST(Sections, OfMeshesAndOfWhatIsCut) {
  PictureRequest request;
  request.background.is_transparent = true;
  const std::string gear = "mesh(\"" + source_file("examples/models/gear.stl") + "\");";
  request.threads = 1;
  const Picture one = slice(gear, {2, 2}, request);
  request.threads = 2;
  EXPECT_EQ(one.rgba, slice(gear, {2, 2}, request).rgba);
  // The gear's own sections by z are all alike.
  const auto covered = [](const Picture& picture) {
    double area = 0;
    for (size_t n = 3; n < picture.rgba.size(); n += 4) area += picture.rgba[n] / 255.0;
    return area * picture.pixel_mm * picture.pixel_mm;
  };
  const double whole = covered(one);
  EXPECT_NEAR(covered(slice(gear, {2, 3}, request)) / whole, 1, 1e-3);
  // Cuts leave half of a disc, and move it to the middle of the picture.
  request.cuts = {{{0, '>', 0}}};
  const Picture half = slice("sphere(10, \"red\");", {2, 0}, request);
  EXPECT_NEAR(covered(half) / (50 * 3.14159265358979), 1, 0.004);
  EXPECT_EQ(dot(half, 140, 100)[3], 255);  // x from -10 to 0: 0 lies 5 mm right of the middle
  EXPECT_EQ(dot(half, 150, 100)[3], 0);
}

TEST(Sections, OfNothingAreSaidToBeEmpty) {
  Diagnostics diagnostics;
  PictureRequest request;
  request.width = request.height = 50;
  request.slice = {{2, 0}};
  request.box = Box{{-1, -1, -10}, {1, 1, 10}};
  EXPECT_TRUE(picture_of("difference() { cube(20); sphere(9); cylinder(3, 40); }", request, diagnostics));
  EXPECT_NE(to_text(diagnostics).find("nothing to be seen"), std::string::npos);
}

TEST(Sections, AreReadAsPeopleWriteThem) {
  EXPECT_EQ(parse_slice("z=3.2")->mm, 3.2);
  EXPECT_EQ(parse_slice(" y = -1 ")->axis, 1);
  for (const char* wrong : {"", "z", "z>3", "z<3", "w=1", "z=nan"}) EXPECT_FALSE(parse_slice(wrong)) << wrong;
}

}  // namespace ombre::compile
