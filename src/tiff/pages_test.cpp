// Tests of TIFF files that are put together byte by byte, as "TIFF Revision 6.0" (Aldus 1992) describes them.
#include "tiff/pages.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <map>

#include "base/system/module_loader.h"
#include "base/text/error.h"

namespace ombre::tiff {
namespace {

// The tags of section 8, and the extensions of sections 15 and 19.
enum Tag : uint16_t {
  subfile_type = 254,
  image_width = 256,
  image_length = 257,
  bits_per_sample = 258,
  compression = 259,
  photometric = 262,
  description = 270,
  strip_offsets = 273,
  orientation = 274,
  samples_per_pixel = 277,
  rows_per_strip = 278,
  strip_byte_counts = 279,
  planar_configuration = 284,
  color_map = 320,
  tile_width = 322,
  tile_length = 323,
  tile_offsets = 324,
  tile_byte_counts = 325,
  sample_format = 339,
};

// A page: its tags with their numbers, and the bytes of its strips or tiles.
struct PlainPage {
  std::map<uint16_t, std::vector<uint32_t>> tags;
  std::vector<std::string> pieces;
};

// A page of one strip. Photometric interpretation 1 is grey with black as 0.
PlainPage grey(uint32_t width, uint32_t height, uint32_t bits, const std::string& strip) {
  return {{{image_width, {width}},
           {image_length, {height}},
           {bits_per_sample, {bits}},
           {photometric, {1}},
           {rows_per_strip, {height}}},
          {strip}};
}

// A page of one strip with a red, a green and a blue sample for each pixel.
PlainPage rgb(uint32_t width, uint32_t height, const std::string& strip) {
  PlainPage page = grey(width, height, 8, strip);
  page.tags[bits_per_sample] = {8, 8, 8};
  page.tags[samples_per_pixel] = {3};
  page.tags[photometric] = {2};
  return page;
}

class TiffWriter {
 public:
  explicit TiffWriter(bool is_big_endian = false) : is_big_endian_(is_big_endian) {
    bytes_ = is_big_endian ? std::string("MM\0*", 4) : std::string("II*\0", 4);
    put(0, 4);
    link_ = 4;
  }

  // Adds a page: its directory, its numbers of more than four bytes, then its pieces.
  void add(PlainPage page) {
    const bool is_tiled = page.tags.contains(tile_width);
    const uint16_t offsets = is_tiled ? tile_offsets : strip_offsets;
    page.tags[is_tiled ? tile_byte_counts : strip_byte_counts].clear();
    for (const std::string& piece : page.pieces)
      page.tags[is_tiled ? tile_byte_counts : strip_byte_counts].push_back(static_cast<uint32_t>(piece.size()));
    page.tags[offsets].resize(page.pieces.size());
    const size_t begin = bytes_.size(), values = begin + 2 + 12 * page.tags.size() + 4;
    size_t end = values;
    for (const auto& [tag, numbers] : page.tags) end += numbers.size() > 1 ? 4 * numbers.size() : 0;
    for (size_t n = 0; n < page.pieces.size(); ++n) {
      page.tags[offsets][n] = static_cast<uint32_t>(end);
      end += page.pieces[n].size();
    }
    set(link_, begin);
    put(page.tags.size(), 2);
    std::string lists;
    for (const auto& [tag, numbers] : page.tags) put_entry(tag, numbers, values, lists);
    link_ = bytes_.size();
    put(0, 4);
    bytes_ += lists;
    for (const std::string& piece : page.pieces) bytes_ += piece;
    if (bytes_.size() % 2 == 1) bytes_ += '\0';  // directories begin on words
  }

  // Lets the last directory be followed by one at this place.
  void link_to(size_t place) { set(link_, place); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string number(uint64_t value, size_t size) const {
    std::string text;
    for (size_t n = 0; n < size; ++n)
      text += static_cast<char>(value >> (8 * (is_big_endian_ ? size - 1 - n : n)) & 255);
    return text;
  }
  void put(uint64_t value, size_t size) { bytes_ += number(value, size); }
  void set(size_t at, uint64_t value) { bytes_.replace(at, 4, number(value, 4)); }

  // Puts an entry of numbers of 32 bits, or of 16 bits for tags that allow no others; a description is letters.
  void put_entry(uint16_t tag, const std::vector<uint32_t>& numbers, size_t values, std::string& lists) {
    const bool is_short = tag == color_map || tag == bits_per_sample || tag == sample_format || tag == compression ||
                          tag == photometric || tag == orientation || tag == samples_per_pixel ||
                          tag == planar_configuration;
    put(tag, 2);
    const bool is_text = tag == description;
    put(is_text ? 2 : is_short ? 3 : 4, 2);
    put(numbers.size(), 4);
    std::string text;
    for (const uint32_t value : numbers) text += number(value, is_text ? 1 : is_short ? 2 : 4);
    if (text.size() <= 4) {
      bytes_ += text;
      bytes_.append(4 - text.size(), '\0');
      lists.append(numbers.size() > 1 ? 4 * numbers.size() : 0, '\0');
      return;
    }
    put(values + lists.size(), 4);
    text.resize(4 * numbers.size());
    lists += text;
  }

  bool is_big_endian_;
  std::string bytes_;
  size_t link_ = 0;  // place of the number that says where the next directory is
};

std::string file_of(const PlainPage& page, bool is_big_endian = false) {
  TiffWriter writer(is_big_endian);
  writer.add(page);
  return writer.bytes();
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::vector<Page> read(const std::string& bytes, Wanted wanted = Wanted::numbers) {
  return read_pages("scan.tif", bytes, wanted, nullptr);
}

std::string failure(const std::string& bytes, Wanted wanted = Wanted::numbers) {
  try {
    read(bytes, wanted);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class Tiff : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_module(*file_format().module)) GTEST_SKIP() << "no TIFF in this build";
  }
};

}  // namespace

TEST(TiffFiles, AreKnownByTheirFirstBytes) {
  using namespace std::string_view_literals;
  for (const std::string_view bytes : {"II*\0"sv, "MM\0*"sv, "II+\0more"sv, "MM\0+"sv}) EXPECT_TRUE(is_tiff(bytes));
  for (const std::string_view bytes : {""sv, "II*"sv, "MM*\0"sv, "II\0*"sv, "\x89PNG"sv, " II*\0"sv})
    EXPECT_FALSE(is_tiff(bytes));
}

TEST_F(Tiff, NumbersAreReadAsTheyAreStored) {
  const std::vector<Page> pages = read(file_of(grey(3, 2, 8, "\x01\x02\x03\xfd\xfe\xff")));
  ASSERT_EQ(pages.size(), 1U);
  EXPECT_EQ(pages[0].width, 3U);
  EXPECT_EQ(pages[0].height, 2U);
  EXPECT_EQ(pages[0].channels, 1U);
  EXPECT_EQ(pages[0].type, "uint8");
  EXPECT_EQ(pages[0].bytes, "\x01\x02\x03\xfd\xfe\xff");
}

TEST_F(Tiff, NumbersHaveTheirTypes) {
  struct Kind {
    std::string type;
    uint32_t bits, format;
    std::string bytes;
  };
  for (const Kind& kind :
       {Kind{"uint16", 16, 1, bytes_of<uint16_t>({1, 65535})}, Kind{"int16", 16, 2, bytes_of<int16_t>({-1, 300})},
        Kind{"int8", 8, 2, bytes_of<int8_t>({-1, 100})}, Kind{"uint32", 32, 1, bytes_of<uint32_t>({1, 4000000000})},
        Kind{"float32", 32, 3, bytes_of<float>({-1.5F, 1e30F})},
        Kind{"float64", 64, 3, bytes_of<double>({0.1, -1e300})}}) {
    PlainPage page = grey(2, 1, kind.bits, kind.bytes);
    page.tags[sample_format] = {kind.format};
    const std::vector<Page> pages = read(file_of(page));
    ASSERT_EQ(pages.size(), 1U);
    EXPECT_EQ(pages[0].type, kind.type);
    EXPECT_EQ(pages[0].bytes, kind.bytes) << kind.type;
  }
}

TEST_F(Tiff, NumbersOfOtherMachinesAreTurnedRound) {
  const std::string big_endian("\x01\x00\x00\x02", 4);
  EXPECT_EQ(read(file_of(grey(2, 1, 16, big_endian), true)).at(0).bytes, bytes_of<uint16_t>({256, 2}));
}

// Photometric interpretation 0: white is 0.
TEST_F(Tiff, GreyIsDarkAtZeroWhateverTheFileSays) {
  PlainPage page = grey(3, 1, 8, std::string("\x00\x01\xff", 3));
  page.tags[photometric] = {0};
  EXPECT_EQ(read(file_of(page)).at(0).bytes, std::string("\xff\xfe\x00", 3));
}

TEST_F(Tiff, ChannelsAreInterleavedWhateverTheFileHas) {
  PlainPage page = rgb(2, 2, "rgbRGB123456");
  EXPECT_EQ(read(file_of(page)).at(0).channels, 3U);
  EXPECT_EQ(read(file_of(page)).at(0).bytes, "rgbRGB123456");
  page.tags[planar_configuration] = {2};  // a strip of each channel
  page.pieces = {"rR14", "gG25", "bB36"};
  EXPECT_EQ(read(file_of(page)).at(0).bytes, "rgbRGB123456");
}

// The sides of tiles are multiples of 16; what lies beyond the image is padding.
TEST_F(Tiff, TilesAreJoinedWithoutTheirPadding) {
  constexpr uint32_t width = 20, height = 18;
  PlainPage page = grey(width, height, 8, "");
  page.tags.erase(rows_per_strip);
  page.tags[tile_width] = {16};
  page.tags[tile_length] = {16};
  page.pieces.clear();
  const auto value = [](uint32_t column, uint32_t row) { return static_cast<char>(row * width + column); };
  for (uint32_t top = 0; top < height; top += 16)
    for (uint32_t left = 0; left < width; left += 16) {
      std::string tile(256, 'x');
      for (uint32_t n = 0; n < 256; ++n)
        if (left + n % 16 < width && top + n / 16 < height) tile[n] = value(left + n % 16, top + n / 16);
      page.pieces.push_back(tile);
    }
  std::string wanted;
  for (uint32_t row = 0; row < height; ++row)
    for (uint32_t column = 0; column < width; ++column) wanted += value(column, row);
  EXPECT_EQ(read(file_of(page)).at(0).bytes, wanted);
}

TEST_F(Tiff, StripsAreJoinedFromTheTop) {
  PlainPage page = grey(2, 5, 8, "");
  page.tags[rows_per_strip] = {2};
  page.pieces = {"abcd", "efgh", "ij"};
  EXPECT_EQ(read(file_of(page)).at(0).bytes, "abcdefghij");
}

// Section 9 has this example of PackBits: 24 bytes from 15.
TEST_F(Tiff, PackedBytesAreUnpacked) {
  PlainPage page = grey(24, 1, 8, std::string("\xFE\xAA\x02\x80\x00\x2A\xFD\xAA\x03\x80\x00\x2A\x22\xF7\xAA", 15));
  page.tags[compression] = {32773};
  EXPECT_EQ(read(file_of(page)).at(0).bytes, std::string("\xAA\xAA\xAA\x80\x00\x2A\xAA\xAA\xAA\xAA\x80\x00\x2A\x22"
                                                         "\xAA\xAA\xAA\xAA\xAA\xAA\xAA\xAA\xAA\xAA",
                                                         24));
}

TEST_F(Tiff, PagesComeInTheirOrder) {
  TiffWriter writer;
  writer.add(grey(2, 1, 8, "ab"));
  writer.add(grey(1, 3, 8, "cde"));
  writer.add(grey(1, 1, 16, "fg"));
  const std::vector<Page> pages = read(writer.bytes());
  ASSERT_EQ(pages.size(), 3U);
  EXPECT_EQ(pages[0].bytes, "ab");
  EXPECT_EQ(pages[1].bytes, "cde");
  EXPECT_EQ(pages[1].height, 3U);
  EXPECT_EQ(pages[2].type, "uint16");
}

TEST_F(Tiff, ColoursAreEightBitsWithOpacity) {
  PlainPage page = rgb(2, 1, "rgbRGB");
  const std::vector<Page> pages = read(file_of(page), Wanted::colours);
  EXPECT_EQ(pages.at(0).channels, 4U);
  EXPECT_EQ(pages.at(0).bytes, "rgb\xffRGB\xff");
  EXPECT_EQ(read(file_of(grey(2, 1, 8, "aZ")), Wanted::colours).at(0).bytes, "aaa\xffZZZ\xff");
}

// Numbers of a palette mean nothing without its colours, and bits are no whole bytes.
TEST_F(Tiff, PalettesAndBitsAreReadAsColours) {
  PlainPage palette = grey(2, 1, 8, std::string("\x01\x00", 2));
  palette.tags[photometric] = {3};
  std::vector<uint32_t> colours(3 * 256);  // 16 bits: all reds, all greens, all blues
  colours[1] = 0xFFFF;
  colours[256 + 0] = 0x8080;
  palette.tags[color_map] = colours;
  EXPECT_EQ(read(file_of(palette)).at(0).bytes, std::string("\xff\x00\x00\xff\x00\x80\x00\xff", 8));
  const std::vector<Page> bits = read(file_of(grey(2, 1, 1, "\x40")));
  EXPECT_EQ(bits.at(0).channels, 4U);
  EXPECT_EQ(bits.at(0).bytes, std::string("\x00\x00\x00\xff\xff\xff\xff\xff", 8));
}

TEST_F(Tiff, TornFilesAreErrors) {
  const std::string whole = file_of(grey(3, 2, 16, "abcdefghijkl"));
  EXPECT_EQ(failure(whole), "");
  for (size_t size = 0; size < whole.size(); ++size) {
    const std::string message = failure(whole.substr(0, size));
    EXPECT_TRUE(message.starts_with("the image \"scan.tif\" cannot be read: ")) << size << ": " << message;
    EXPECT_NE(failure(whole.substr(0, size), Wanted::colours), "") << size;
  }
}

// The high bytes of width and height, the values of the first two entries, would only take memory and time.
TEST_F(Tiff, BrokenBytesNeverCrash) {
  PlainPage page = grey(3, 2, 16, "abcdefghijkl");
  page.tags[sample_format] = {2};
  const std::string whole = file_of(page);
  for (size_t at = 0; at < whole.size(); ++at)
    for (const int flip : {0x01, 0x80}) {
      if (at == 19 || at == 20 || at == 21 || at == 31 || at == 32 || at == 33) continue;
      std::string broken = whole;
      broken[at] = static_cast<char>(broken[at] ^ flip);
      try {
        for (const Page& found : read(broken, flip == 1 ? Wanted::numbers : Wanted::colours))
          EXPECT_GT(found.bytes.size(), 0U);
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("scan.tif"), std::string::npos);
      }
    }
}

TEST_F(Tiff, WhatIsNotReadSaysWhy) {
  const auto changed = [](Tag tag, uint32_t value) {
    PlainPage page = grey(2, 1, 8, "ab");
    page.tags[tag] = {value};
    return failure(file_of(page));
  };
  EXPECT_NE(changed(orientation, 3).find("its rows do not go down from the top left"), std::string::npos);
  EXPECT_NE(changed(image_width, 0), "");
  PlainPage large = grey(100'000, 100'000, 8, "ab");
  EXPECT_NE(failure(file_of(large)).find("more than 10^9 pixels"), std::string::npos);
  EXPECT_NE(changed(compression, 65001), "");
  EXPECT_NE(changed(samples_per_pixel, 2000), "");
  for (const char* other : {"", "not an image", "\x89PNG\r\n\x1a\n", "II"}) EXPECT_NE(failure(other), "") << other;
}

TEST_F(Tiff, PagesThatFollowThemselvesEnd) {
  TiffWriter writer;
  writer.add(grey(2, 1, 8, "ab"));
  writer.link_to(8);
  EXPECT_EQ(read(writer.bytes()).size(), 1U);
}

TEST_F(Tiff, ReadingStopsOnRequest) {
  StopFlag stop;
  EXPECT_EQ(read_pages("scan.tif", file_of(grey(2, 1, 8, "ab")), Wanted::numbers, &stop).size(), 1U);
  stop.request();
  EXPECT_THROW(read_pages("scan.tif", file_of(grey(2, 1, 8, "ab")), Wanted::numbers, &stop), Cancelled);
}

namespace {

std::vector<uint32_t> letters(const std::string& text) {
  std::vector<uint32_t> list(text.begin(), text.end());
  list.push_back(0);
  return list;
}

}  // namespace

// Bits 0 and 2 of NewSubfileType: a smaller copy, a mask.
TEST_F(Tiff, ThumbnailsAndMasksAreLeftOut) {
  TiffWriter writer;
  for (const uint32_t kind : {0U, 1U, 2U, 4U}) {
    PlainPage page = grey(2, 1, 8, std::string(2, static_cast<char>('a' + kind)));
    page.tags[subfile_type] = {kind};
    writer.add(page);
  }
  const Document document = read_document("scan.tif", writer.bytes(), Wanted::numbers, nullptr);
  ASSERT_EQ(document.pages.size(), 2U);
  EXPECT_EQ(document.pages[1].bytes, "cc");
  EXPECT_EQ(document.reduced, 2U);
}

// ImageJ's stacks of more than 4 GiB have one directory; their images follow each other.
TEST_F(Tiff, LargeStacksOfImageJHaveOneDirectory) {
  for (const bool is_big_endian : {false, true}) {
    const std::string first = is_big_endian ? std::string("\0\1\0\2", 4) : std::string("\1\0\2\0", 4),
                      second = is_big_endian ? std::string("\0\3\0\4", 4) : std::string("\3\0\4\0", 4);
    PlainPage page = grey(2, 1, 16, first);
    page.tags[description] = letters("ImageJ=1.53t\nimages=2\nslices=2\n");
    const std::string file = file_of(page, is_big_endian);
    const std::vector<Page> pages = read(file + second);
    ASSERT_EQ(pages.size(), 2U);
    EXPECT_EQ(pages[0].bytes, bytes_of<uint16_t>({1, 2}));
    EXPECT_EQ(pages[1].bytes, bytes_of<uint16_t>({3, 4}));
    EXPECT_NE(failure(file).find("cut off: its description gives 2 images"), std::string::npos) << failure(file);
  }
}

TEST_F(Tiff, NumbersThatAreNotReadAreErrors) {
  const auto of = [](uint32_t bits, uint32_t format) {
    PlainPage page = grey(2, 1, bits, std::string(bits / 4, 'a'));
    page.tags[sample_format] = {format};
    return failure(file_of(page));
  };
  EXPECT_NE(of(16, 3).find("floats of 16 bits"), std::string::npos);
  EXPECT_NE(of(64, 1).find("integers of 64 bits"), std::string::npos);
  EXPECT_NE(of(64, 6).find("complex"), std::string::npos);
}

}  // namespace ombre::tiff
