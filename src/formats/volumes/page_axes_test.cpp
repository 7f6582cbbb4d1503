// Tests of descriptions of TIFF pages, as ImageJ and OME write them.
#include "formats/volumes/page_axes.h"

#include <gtest/gtest.h>

#include "base/text/error.h"
#include "base/text/test_errors.h"

namespace ombre::formats {
namespace {

std::string axes_problem(const std::string& text) {
  return failure_of([&] { page_axes("v", text); });
}

bool mentions(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

#ifdef OMBRE_3MF
std::string ome(const std::string& attributes, const std::string& content = "") {
  return R"(<?xml version="1.0"?><OME xmlns="http://www.openmicroscopy.org/Schemas/OME/2016-06"><Image ID="Image:0">)"
         R"(<Pixels ID="Pixels:0" SizeX="2" SizeY="2" )" +
         attributes + ">" + content + "</Pixels></Image></OME>";
}
#endif

}  // namespace

TEST(PageAxes, OtherDescriptionsSayNothing) {
  EXPECT_FALSE(page_axes("v", ""));
  EXPECT_FALSE(page_axes("v", "a photograph"));
  EXPECT_FALSE(page_axes("v", R"({"shape": [2, 3, 4]})"));
}

// ImageJ's hyperstacks have channels fastest, then slices, then frames.
TEST(PageAxes, ImageJHyperstacksAreReadInTheirOrder) {
  const auto axes = page_axes(
      "v", "ImageJ=1.53t\nimages=24\nchannels=2\nslices=3\nframes=4\nhyperstack=true\nspacing=2.5\nunit=micron\n");
  ASSERT_TRUE(axes);
  EXPECT_EQ(axes->channels, 2);
  EXPECT_EQ(axes->slices, 3);
  EXPECT_EQ(axes->frames, 4);
  EXPECT_EQ(axes->plane(0, 1, 0), 1);
  EXPECT_EQ(axes->plane(1, 0, 0), 2);
  EXPECT_EQ(axes->plane(2, 1, 3), 23);
  EXPECT_DOUBLE_EQ(axes->z_mm.value(), 2.5e-3);
  EXPECT_DOUBLE_EQ(axes->unit_mm.value(), 1e-3);
}

TEST(PageAxes, PlainStacksOfImageJAreSlices) {
  const auto axes = page_axes("v", "ImageJ=1.11a\nimages=7\nunit=pixel\nspacing=1\n");
  ASSERT_TRUE(axes);
  EXPECT_EQ(axes->slices, 7);
  EXPECT_FALSE(axes->z_mm);
  EXPECT_TRUE(mentions(axes_problem("ImageJ=1.11a\nimages=7\nslices=3\n"), "7 images"));
  EXPECT_TRUE(mentions(axes_problem("ImageJ=1.11a\nimages=x\n"), "wrong \"images\""));
  EXPECT_TRUE(mentions(axes_problem("ImageJ=1.11a\nimages=1e30\n"), "wrong \"images\""));
}

#ifdef OMBRE_3MF

TEST(PageAxes, OmeSaysTheOrderOfAxesAndLengths) {
  const auto axes = page_axes(
      "v", ome(R"(DimensionOrder="XYZCT" SizeZ="3" SizeC="2" SizeT="1" PhysicalSizeX="0.5" PhysicalSizeY="500" )"
               R"(PhysicalSizeYUnit="nm" PhysicalSizeZ="2" PhysicalSizeZUnit="mm")",
               R"(<Channel ID="c0" SamplesPerPixel="1" Name="DAPI"/><Channel ID="c1" SamplesPerPixel="1"/>)"));
  ASSERT_TRUE(axes);
  EXPECT_EQ(axes->plane(1, 0, 0), 1);
  EXPECT_EQ(axes->plane(0, 1, 0), 3);
  EXPECT_DOUBLE_EQ(axes->x_mm.value(), 0.5e-3);
  EXPECT_DOUBLE_EQ(axes->y_mm.value(), 0.5e-3);
  EXPECT_DOUBLE_EQ(axes->z_mm.value(), 2);
  EXPECT_EQ(axes->channel_names, (std::vector<std::string>{"DAPI", ""}));
}

TEST(PageAxes, SamplesOfAPixelShareAPage) {
  const auto axes = page_axes(
      "v", ome(R"(DimensionOrder="XYCZT" SizeZ="4" SizeC="3" SizeT="1")", R"(<Channel ID="c0" SamplesPerPixel="3"/>)"));
  ASSERT_TRUE(axes);
  EXPECT_EQ(axes->channels, 1);
  EXPECT_EQ(axes->count(), 4);
}

TEST(PageAxes, OmeMayNameThePages) {
  const auto axes = page_axes(
      "v", ome(R"(DimensionOrder="XYZCT" SizeZ="2" SizeC="1" SizeT="1")",
               R"(<TiffData IFD="1" FirstZ="0" PlaneCount="1"/><TiffData IFD="0" FirstZ="1" PlaneCount="1"/>)"));
  ASSERT_TRUE(axes);
  EXPECT_EQ(axes->pages, (std::vector<int64_t>{1, 0}));
}

TEST(PageAxes, WrongOmeDescriptionsAreErrors) {
  EXPECT_TRUE(mentions(axes_problem(ome(R"(DimensionOrder="XYZCQ" SizeZ="2" SizeC="1" SizeT="1")")), "DimensionOrder"));
  EXPECT_TRUE(mentions(axes_problem(ome(R"(DimensionOrder="XYZCT" SizeZ="0" SizeC="1" SizeT="1")")), "SizeZ"));
  EXPECT_TRUE(mentions(axes_problem(ome(R"(DimensionOrder="XYZCT" SizeZ="99999" SizeC="99999" SizeT="9")")), "planes"));
  EXPECT_TRUE(mentions(axes_problem("<OME><Image>"), "cannot be read"));
  EXPECT_TRUE(mentions(axes_problem(ome(R"(DimensionOrder="XYZCT" SizeZ="2" SizeC="1" SizeT="1")",
                                        R"(<TiffData IFD="0"><UUID FileName="a.tif">1</UUID></TiffData>)"
                                        R"(<TiffData IFD="0" FirstZ="1"><UUID FileName="b.tif">2</UUID></TiffData>)")),
                       "several files"));
  EXPECT_TRUE(
      mentions(axes_problem(ome(R"(DimensionOrder="XYZCT" SizeZ="2" SizeC="1" SizeT="1")", R"(<TiffData IFD="0"/>)")),
               "no page for some planes"));
}

#endif

}  // namespace ombre::formats
