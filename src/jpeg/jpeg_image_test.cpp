// Tests of JPEG files that are put together byte by byte, as ITU-T T.81 (1992) describes them.
#include "jpeg/jpeg_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/system/module_loader.h"
#include "base/text/error.h"
#include "jpeg/orientation.h"

namespace ombre::jpeg {
namespace {

using Bytes = std::string;

Bytes byte(int value) { return Bytes(1, static_cast<char>(value)); }
Bytes word(int value) { return byte(value >> 8) + byte(value & 255); }
Bytes segment(int marker, const Bytes& body) {
  return byte(0xFF) + byte(marker) + word(static_cast<int>(body.size()) + 2) + body;
}

const Bytes start = "\xFF\xD8", end = "\xFF\xD9";

// Bits of entropy-coded data: padded with ones, and a zero follows each byte of ones.
class Bits {
 public:
  Bits& add(unsigned value, int count) {
    for (int n = count - 1; n >= 0; --n) bits_ += static_cast<char>((value >> n) & 1);
    return *this;
  }
  // A difference of DC coefficients: its size, whose code has four bits, and its bits (F.1.2.1).
  Bits& dc(int difference) {
    const int size = difference == 0 ? 0 : static_cast<int>(std::log2(std::abs(difference))) + 1;
    add(static_cast<unsigned>(size), 4);
    return add(static_cast<unsigned>(difference < 0 ? difference + (1 << size) - 1 : difference), size);
  }
  Bits& end_of_block() { return add(0, 2); }
  Bytes bytes() const {
    Bytes out, bits = bits_;
    while (bits.size() % 8 != 0) bits += '\1';
    for (size_t at = 0; at < bits.size(); at += 8) {
      int value = 0;
      for (size_t n = 0; n < 8; ++n) value = 2 * value + bits[at + n];
      out += byte(value);
      if (value == 255) out += '\0';
    }
    return out;
  }

 private:
  Bytes bits_;
};

// The divisor of the DC coefficient is 8, so that one is one level; those of the others are 1.
Bytes divisors() { return segment(0xDB, byte(0) + byte(8) + Bytes(63, '\1')); }

// DC: the sizes 0 to 11 have codes of four bits. AC: the end of a block is 00, a number of eight bits 01.
Bytes codes() {
  Bytes dc = byte(0x00) + Bytes(3, '\0') + byte(12) + Bytes(12, '\0'), ac = byte(0x10) + byte(0) + byte(2);
  for (int size = 0; size < 12; ++size) dc += byte(size);
  return segment(0xC4, dc) + segment(0xC4, ac + Bytes(14, '\0') + byte(0) + byte(8));
}

Bytes frame(int width, int height, int components, int kind = 0xC0, int bits = 8) {
  Bytes body = byte(bits) + word(height) + word(width) + byte(components);
  for (int n = 0; n < components; ++n) body += byte(n + 1) + byte(0x11) + byte(0);
  return segment(kind, body);
}

Bytes scan(int components, const Bytes& data, int first = 0, int last = 63, int bits = 0) {
  Bytes body = byte(components);
  for (int n = 0; n < components; ++n) body += byte(n + 1) + byte(0);
  return segment(0xDA, body + byte(first) + byte(last) + byte(bits)) + data;
}

// Adobe's segment says how colours are stored: 0 as they are, 1 YCbCr, 2 YCCK.
Bytes adobe(int transform) { return segment(0xEE, "Adobe" + word(100) + word(0) + word(0) + byte(transform)); }

// A picture in grey, with one level for each block of 8 by 8 pixels.
Bytes flat(int width, int height, const std::vector<int>& levels, const Bytes& more = "") {
  Bits bits;
  int before = 128;
  for (const int level : levels) {
    bits.dc(level - before).end_of_block();
    before = level;
  }
  return start + more + divisors() + frame(width, height, 1) + codes() + scan(1, bits.bytes()) + end;
}

// A picture of one block, whose components have these levels.
Bytes block(const std::vector<int>& levels, const Bytes& more) {
  Bits bits;
  for (const int level : levels) bits.dc(level - 128).end_of_block();
  const int count = static_cast<int>(levels.size());
  return start + more + divisors() + frame(8, 8, count) + codes() + scan(count, bits.bytes()) + end;
}

Picture read(const Bytes& bytes) { return decode("a.jpg", bytes, 1 << 20); }

std::vector<int> pixel(const Picture& picture, size_t column, size_t row) {
  const size_t at = 4 * (row * picture.width + column);
  return {picture.rgba.begin() + static_cast<ptrdiff_t>(at), picture.rgba.begin() + static_cast<ptrdiff_t>(at + 4)};
}

using Pixel = std::vector<int>;

class Jpeg : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_module(*file_format().module)) GTEST_SKIP() << without(*file_format().module);
  }

  static void expect_message(const Bytes& bytes, const std::string& text) {
    try {
      read(bytes);
      ADD_FAILURE() << "it was read, instead of: " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("a.jpg"), std::string::npos) << error.what();
    }
  }
};

TEST_F(Jpeg, FlatBlocksAreExact) {
  const Picture picture = read(flat(19, 9, {0, 128, 255, 7, 200, 31}));
  ASSERT_EQ(picture.width, 19U);
  ASSERT_EQ(picture.height, 9U);
  ASSERT_EQ(picture.rgba.size(), 19U * 9 * 4);
  EXPECT_EQ(pixel(picture, 0, 0), (Pixel{0, 0, 0, 255}));
  EXPECT_EQ(pixel(picture, 7, 7), (Pixel{0, 0, 0, 255}));
  EXPECT_EQ(pixel(picture, 8, 0), (Pixel{128, 128, 128, 255}));
  EXPECT_EQ(pixel(picture, 18, 7), (Pixel{255, 255, 255, 255}));
  EXPECT_EQ(pixel(picture, 0, 8), (Pixel{7, 7, 7, 255}));
  EXPECT_EQ(pixel(picture, 15, 8), (Pixel{200, 200, 200, 255}));
  EXPECT_EQ(pixel(picture, 16, 8), (Pixel{31, 31, 31, 255}));
}

// A coefficient adds its cosine (A.3.3).
TEST_F(Jpeg, CoefficientsAreWaves) {
  constexpr int coefficient = 200;
  Bits bits;
  bits.dc(0).add(1, 2).add(coefficient, 8).end_of_block();
  const Picture picture = read(start + divisors() + frame(8, 8, 1) + codes() + scan(1, bits.bytes()) + end);
  for (size_t x = 0; x < 8; ++x) {
    const double wave = std::cos(static_cast<double>(2 * x + 1) * std::numbers::pi / 16);
    for (size_t y = 0; y < 8; ++y)
      EXPECT_NEAR(pixel(picture, x, y)[0], 128 + coefficient / (4 * std::numbers::sqrt2) * wave, 0.51 + 0.5) << x;
  }
}

TEST_F(Jpeg, ColoursAreStoredInThreeWays) {
  EXPECT_EQ(pixel(read(block({250, 20, 130}, adobe(0))), 3, 3), (Pixel{250, 20, 130, 255}));
  // R = Y + 1.402 (Cr - 128), G = Y - 0.344136 (Cb - 128) - 0.714136 (Cr - 128), B = Y + 1.772 (Cb - 128) (JFIF 1.02).
  const Pixel colour = pixel(read(block({100, 90, 160}, "")), 3, 3);
  EXPECT_NEAR(colour[0], 100 + 1.402 * 32, 1);
  EXPECT_NEAR(colour[1], 100 + 0.344136 * 38 - 0.714136 * 32, 1);
  EXPECT_NEAR(colour[2], 100 - 1.772 * 38, 1);
  EXPECT_EQ(pixel(read(block({77, 128, 128}, adobe(1))), 3, 3), (Pixel{77, 77, 77, 255}));
}

TEST_F(Jpeg, ColoursOfInksAreRefused) {
  expect_message(block({1, 2, 3, 4}, adobe(0)), "CMYK");
  expect_message(block({1, 2, 3, 4}, adobe(2)), "save it in RGB");
  expect_message(block({1, 2, 3, 4}, ""), "CMYK");
  expect_message(block({1, 2}, ""), "neither one value nor three");
}

// A progressive file: the level with all bits but the last, then that bit, then the waves.
TEST_F(Jpeg, ProgressiveFilesAreRead) {
  const Bytes data = scan(1, Bits().dc((201 - 128) >> 1).bytes(), 0, 0, 0x01) +
                     scan(1, Bits().add(1, 1).bytes(), 0, 0, 0x10) + scan(1, Bits().end_of_block().bytes(), 1, 63);
  const Picture picture = read(start + divisors() + frame(8, 8, 1, 0xC2) + codes() + data + end);
  for (size_t n = 0; n < 8; ++n) EXPECT_EQ(pixel(picture, n, 7 - n), (Pixel{201, 201, 201, 255}));
}

TEST_F(Jpeg, ManyScansAreRefused) {
  Bytes data = scan(1, Bits().dc(0).bytes(), 0, 0);
  for (int coefficient = 1; coefficient < 64; ++coefficient)
    for (int bit = 13; bit >= 0; --bit)
      data += scan(1, Bits().end_of_block().bytes(), coefficient, coefficient, (bit == 13 ? 0 : bit + 1) << 4 | bit);
  expect_message(start + divisors() + frame(8, 8, 1, 0xC2) + codes() + data + end, "more than 500 scans");
}

TEST_F(Jpeg, BrokenFilesSayWhatIsWrong) {
  const Bytes whole = flat(19, 9, {0, 128, 255, 7, 200, 31});
  for (size_t size = 0; size < whole.size(); ++size) EXPECT_THROW(read(whole.substr(0, size)), Error) << size;
  expect_message("", "a.jpg");
  expect_message(start + end, "as a JPEG image");
  expect_message(start + divisors() + frame(0, 8, 1) + end, "as a JPEG image");
  expect_message(start + divisors() + frame(8, 8, 1, 0xC1, 12) + codes() + scan(1, "") + end, "as a JPEG image");
  // No table has this code.
  expect_message(start + divisors() + frame(8, 8, 1) + codes() + scan(1, byte(0xF0)) + end, "as a JPEG image");
  Bytes crowded = whole;
  crowded.insert(crowded.size() - 2, "rubbish");
  expect_message(crowded, "extraneous bytes");
  for (size_t at = 2; at < whole.size(); ++at)
    for (const int change : {1, 128, 255}) {
      Bytes changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ change);
      try {
        const Picture picture = read(changed);
        EXPECT_EQ(picture.rgba.size(), size_t{4} * picture.width * picture.height);
      } catch (const Error&) {
        continue;
      }
    }
}

TEST_F(Jpeg, SizesAreCheckedBeforeMemoryIsTaken) {
  const Bytes rest = codes() + scan(1, Bits().dc(0).end_of_block().bytes()) + end;
  expect_message(start + divisors() + frame(1025, 1024, 1) + rest, "it has 1025 x 1024 pixels, more than 1048576");
  try {
    decode("a.jpg", start + divisors() + frame(65000, 65000, 1) + rest, uint64_t{1} << 40);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("too short for 65000 x 65000 pixels"), std::string::npos) << error.what();
  }
}

Bytes exif(bool is_little, int orientation) {
  const auto number = [&](int value, int size) {
    Bytes bytes = size == 4 ? word(value >> 16) + word(value & 0xFFFF) : word(value);
    if (is_little) std::ranges::reverse(bytes);
    return bytes;
  };
  const auto entry = [&](int tag, int value) {
    return number(tag, 2) + number(3, 2) + number(1, 4) + number(value, 2) + number(0, 2);
  };
  const Bytes header = (is_little ? "II" : "MM") + number(42, 2) + number(8, 4);
  return segment(
      0xE1, Bytes("Exif\0\0", 6) + header + number(2, 2) + entry(0x0100, 640) + entry(274, orientation) + number(0, 4));
}

TEST(JpegOrientation, IsThatOfTheCamera) {
  for (int orientation = 1; orientation <= 8; ++orientation)
    for (const bool is_little : {false, true}) {
      const Bytes other = segment(0xE0, Bytes("JFIF\0", 5) + Bytes(9, '\0')) + segment(0xE1, "http://ns.adobe.com/xap");
      EXPECT_EQ(orientation_of(flat(8, 8, {9}, other + exif(is_little, orientation))), orientation);
    }
  EXPECT_EQ(orientation_of(flat(8, 8, {9}, exif(true, 0))), 1);
  EXPECT_EQ(orientation_of(flat(8, 8, {9}, exif(true, 9))), 1);
  EXPECT_EQ(orientation_of(flat(8, 8, {9})), 1);
  const Bytes whole = flat(8, 8, {9}, exif(false, 6));
  for (size_t size = 0; size < whole.size(); ++size) {
    const int found = orientation_of(std::string_view(whole).substr(0, size));
    EXPECT_TRUE(found == 1 || found == 6) << size;
  }
}

// Where the stored first row and first column lie in what is seen (Exif 2.32, tag 274).
TEST(JpegOrientation, TurnsPicturesAsExifSays) {
  struct Case {
    int orientation;
    std::string_view first_row, first_column;
  };
  constexpr Case cases[]{{1, "top", "left"}, {2, "top", "right"}, {3, "bottom", "right"}, {4, "bottom", "left"},
                         {5, "left", "top"}, {6, "right", "top"}, {7, "right", "bottom"}, {8, "left", "bottom"}};
  // Three columns, two rows; red counts columns, green counts rows.
  Picture stored{3, 2, {}};
  for (uint8_t row = 0; row < 2; ++row)
    for (uint8_t column = 0; column < 3; ++column) stored.rgba.insert(stored.rgba.end(), {column, row, 0, 255});
  for (const auto& [orientation, first_row, first_column] : cases) {
    const Picture seen = turned(stored, orientation);
    const bool is_upright = first_row == "top" || first_row == "bottom";
    ASSERT_EQ(seen.width, is_upright ? 3U : 2U) << orientation;
    ASSERT_EQ(seen.height, is_upright ? 2U : 3U) << orientation;
    const auto is_at = [&](std::string_view side, size_t column, size_t row) {
      return side == "top"      ? row == 0
             : side == "left"   ? column == 0
             : side == "bottom" ? row == seen.height - 1
                                : column == seen.width - 1;
    };
    for (size_t row = 0; row < seen.height; ++row)
      for (size_t column = 0; column < seen.width; ++column) {
        EXPECT_EQ(pixel(seen, column, row)[1] == 0, is_at(first_row, column, row)) << orientation;
        EXPECT_EQ(pixel(seen, column, row)[0] == 0, is_at(first_column, column, row)) << orientation;
      }
  }
}

}  // namespace
}  // namespace ombre::jpeg
