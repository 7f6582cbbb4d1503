// Tests of the choice of pages: one channel and one frame of a stack.
#include "sources/tiff_stack.h"

#include <gtest/gtest.h>

#include "base/text/test_errors.h"

namespace ombre::sources {
namespace {

tiff::Document imagej_stack(size_t pages, const std::string& axes, double pixels_a_unit = 0) {
  tiff::Document document;
  document.pages.resize(pages, {2, 2, 1, "uint8", "abcd"});
  document.description = "ImageJ=1.11a\nimages=" + std::to_string(pages) + "\n" + axes;
  document.pixels_x = document.pixels_y = pixels_a_unit;
  return document;
}

formats::VolumeChoice choice_of(int channel, int phase = 0) {
  formats::VolumeChoice choice;
  choice.channel = channel;
  choice.phase = phase;
  return choice;
}

std::string stack_problem(const tiff::Document& document, const formats::VolumeChoice& choice = {}) {
  return failure_of([&] { chosen_pages("v.tif", document, choice); });
}

}  // namespace

TEST(TiffStack, PagesWithoutADescriptionAreSlices) {
  tiff::Document document;
  document.pages.resize(3);
  document.reduced = 1;
  const ChosenPages chosen = chosen_pages("v.tif", document, {});
  EXPECT_EQ(chosen.pages, (std::vector<size_t>{0, 1, 2}));
  EXPECT_FALSE(chosen.spacing_mm);
  EXPECT_EQ(chosen.warnings.size(), 1U);
}

TEST(TiffStack, OneChannelOfAHyperstackIsChosen) {
  const tiff::Document document = imagej_stack(12, "channels=2\nslices=3\nframes=2\n");
  EXPECT_EQ(chosen_pages("v.tif", document, choice_of(1, 1)).pages, (std::vector<size_t>{1, 3, 5}));
  EXPECT_EQ(chosen_pages("v.tif", document, choice_of(0, 2)).pages, (std::vector<size_t>{6, 8, 10}));
  EXPECT_EQ(stack_problem(document), "the volume \"v.tif\" has 2 channels; choose one by channel=0, up to 1");
  EXPECT_EQ(stack_problem(document, choice_of(0)),
            "the volume \"v.tif\" has 2 frames in time; choose one by phase=1, up to 2");
  EXPECT_EQ(stack_problem(document, choice_of(2, 1)), "the volume \"v.tif\" has no channel 2; 0 to 1 are there");
}

// ImageJ writes pixels for each unit of length, and the distance between slices in that unit.
TEST(TiffStack, LengthsHaveTheUnitOfTheDescription) {
  const ChosenPages chosen = chosen_pages("v.tif", imagej_stack(2, "slices=2\nspacing=2\nunit=mm\n", 4), {});
  ASSERT_TRUE(chosen.spacing_mm);
  EXPECT_EQ(*chosen.spacing_mm, (Vec3{0.25, 0.25, 2}));
  EXPECT_FALSE(chosen_pages("v.tif", imagej_stack(2, "slices=2\nspacing=2\nunit=pixel\n", 4), {}).spacing_mm);
}

TEST(TiffStack, MissingPagesAreAnError) {
  tiff::Document document = imagej_stack(12, "channels=2\nslices=3\nframes=2\n");
  document.pages.pop_back();
  EXPECT_NE(stack_problem(document, choice_of(0, 1)).find("has 11 pages, where its description gives 12"),
            std::string::npos);
}

}  // namespace ombre::sources
