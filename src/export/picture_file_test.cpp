#include "export/picture_file.h"

#include <gtest/gtest.h>

namespace ombre::exporting {

TEST(Picture, BeginsInOneColour) {
  const Picture picture(3, 2, {10, 20, 30, 40});
  ASSERT_EQ(picture.rgba.size(), 24U);
  for (size_t n = 0; n < picture.rgba.size(); ++n) EXPECT_EQ(picture.rgba[n], 10 * (n % 4 + 1));
}

TEST(Picture, HasRowsFromTheTopAndIgnoresWhatLiesBeside) {
  Picture picture(3, 2, {0, 0, 0, 0});
  picture.set(1, 1, {1, 2, 3, 4});
  for (const auto& [column, row] : {std::pair(3U, 0U), {0U, 2U}, {UINT32_MAX, UINT32_MAX}, {3U, 1U}})
    picture.set(column, row, {9, 9, 9, 9});
  for (size_t n = 0; n < picture.rgba.size(); ++n) EXPECT_EQ(picture.rgba[n], n / 4 == 4 ? n - 15 : 0U) << n;
}

}  // namespace ombre::exporting
