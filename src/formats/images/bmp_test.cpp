#include "formats/images/bmp.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/text/error.h"
#include "base/text/test_errors.h"

namespace ombre::formats {
namespace {

template <class T>
void put_number(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Returns a bitmap of 2 x 2 pixels: a header of 40 bytes; a palette, masks or nothing; and rows.
std::string small_bmp(uint16_t bits, const std::string& table, const std::string& rows, uint32_t packing = 0,
                      int32_t height = 2) {
  std::string bytes = "BM";
  put_number<uint32_t>(bytes, 0);
  put_number<uint32_t>(bytes, 0);
  put_number<uint32_t>(bytes, static_cast<uint32_t>(54 + table.size()));
  put_number<uint32_t>(bytes, 40);
  put_number<int32_t>(bytes, 2);
  put_number<int32_t>(bytes, height);
  put_number<uint16_t>(bytes, 1);
  put_number<uint16_t>(bytes, bits);
  put_number<uint32_t>(bytes, packing);
  for (int n = 0; n < 5; ++n) put_number<uint32_t>(bytes, 0);
  return bytes + table + rows;
}

// Red and green above blue and white.
const std::vector<uint8_t> four_colours{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};

std::string bmp_problem(const std::string& bytes) {
  return failure_of([&] { decode_bmp(bytes, "a.bmp"); });
}

}  // namespace

TEST(Bmp, PixelsOfAllKindsAreRead) {
  using namespace std::string_literals;
  // Palettes and pixels start with blue.
  const std::string palette = "\xFF\0\0\0\xFF\xFF\xFF\0\0\0\xFF\0\0\xFF\0\0"s;  // blue, white, red, green
  const std::string wide = palette + std::string(48, '\0'), widest = palette + std::string(1008, '\0');
  EXPECT_EQ(decode_bmp(small_bmp(4, wide, "\x01\0\0\0\x23\0\0\0"s), "a").rgba, four_colours);
  EXPECT_EQ(decode_bmp(small_bmp(8, widest, "\0\x01\0\0\x02\x03\0\0"s), "a").rgba, four_colours);
  const std::string low = "\xFF\0\0\xFF\xFF\xFF\0\0"s, high = "\0\0\xFF\0\xFF\0\0\0"s;
  EXPECT_EQ(decode_bmp(small_bmp(24, "", low + high), "a").rgba, four_colours);
  EXPECT_EQ(decode_bmp(small_bmp(24, "", high + low, 0, -2), "a").rgba, four_colours);
  EXPECT_EQ(decode_bmp(small_bmp(32, "", "\xFF\0\0\0\xFF\xFF\xFF\0\0\0\xFF\0\0\xFF\0\0"s), "a").rgba, four_colours);
  EXPECT_EQ(decode_bmp(small_bmp(16, "", "\x1F\0\xFF\x7F\0\x7C\xE0\x03"s), "a").rgba, four_colours);
  // Masks define 5, 6 and 5 bits.
  const std::string masks = "\0\xF8\0\0\xE0\x07\0\0\x1F\0\0\0"s;
  EXPECT_EQ(decode_bmp(small_bmp(16, masks, "\x1F\0\xFF\xFF\0\xF8\xE0\x07"s, 3), "a").rgba, four_colours);
}

TEST(Bmp, WrongFilesSayWhatIsWrong) {
  const std::string whole = small_bmp(24, "", std::string(16, 'x'));
  EXPECT_EQ(bmp_problem(whole), "no error");
  for (size_t n = 2; n < whole.size(); ++n)
    EXPECT_NE(bmp_problem(whole.substr(0, n)).find("it is cut off"), std::string::npos) << n;
  EXPECT_NE(bmp_problem(small_bmp(8, "", "", 1)).find("it is compressed"), std::string::npos);
  EXPECT_NE(bmp_problem(small_bmp(7, "", "")).find("it has 7 bits a pixel"), std::string::npos);
  EXPECT_NE(bmp_problem(small_bmp(24, "", "", 0, 2'000'000'000)).find("more than 10^9 pixels"), std::string::npos);
}

}  // namespace ombre::formats
