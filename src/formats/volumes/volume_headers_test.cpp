#include <gtest/gtest.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>

#include "formats/containers/gzip.h"
#include "formats/volumes/npy.h"
#include "formats/volumes/nrrd.h"

namespace ombre::formats {
namespace {

std::string unzip(const std::string& stream, size_t size) {
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> reader(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  std::string out(size, '\0');
  size_t made = 0;
  const auto status =
      libdeflate_gzip_decompress(reader.get(), stream.data(), stream.size(), out.data(), out.size(), &made);
  EXPECT_EQ(status, LIBDEFLATE_SUCCESS);
  EXPECT_EQ(made, size);
  return out;
}

std::string zip(const std::string& bytes, size_t number, size_t row, size_t piece) {
  GzipWriter writer(number, row);
  std::string stream;
  for (size_t n = 0; n < bytes.size(); n += piece) {
    writer.add(reinterpret_cast<const uint8_t*>(bytes.data()) + n, std::min(piece, bytes.size() - n));
    stream += writer.take();
  }
  writer.finish();
  return stream + writer.take();
}

// Returns floats that repeat along rows, from row to row, or not at all.
std::string numbers(size_t width, size_t rows) {
  std::string bytes;
  uint32_t state = 1;
  for (size_t j = 0; j < rows; ++j)
    for (size_t i = 0; i < width; ++i) {
      state = state * 1664525 + 1013904223;
      const float value = j % 7 == 0 ? static_cast<float>(state) : j % 7 == 1 ? 0.25f : static_cast<float>(i) * 0.1f;
      char raw[sizeof value];
      std::memcpy(raw, &value, sizeof value);
      bytes.append(raw, sizeof value);
    }
  return bytes;
}

}  // namespace

TEST(Npy, HeaderEndsAtAMultipleOf64) {
  const std::string header = npy_header("<f4", {7, 11, 13});
  EXPECT_EQ(header.size() % 64, 0u);
  EXPECT_EQ(header.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  EXPECT_EQ(static_cast<uint8_t>(header[8]) + 256u * static_cast<uint8_t>(header[9]), header.size() - 10);
  EXPECT_NE(header.find("{'descr': '<f4', 'fortran_order': False, 'shape': (7, 11, 13, ), }"), std::string::npos);
  EXPECT_EQ(header.back(), '\n');
}

TEST(Nrrd, HeaderHasSpaceInMillimetres) {
  NrrdHeader header;
  header.type = "uint8";
  header.count = {3, 4, 5};
  header.spacing_mm = {0.1, 0.2, 0.027};
  header.origin_mm = {-1.5, 0, 2};
  header.notes = {{"values", "two\nlines"}};
  const std::string text = nrrd_header(header);
  EXPECT_EQ(text.substr(0, 9), "NRRD0004\n");
  EXPECT_NE(text.find("\nsizes: 3 4 5\n"), std::string::npos);
  EXPECT_NE(text.find("\nspace directions: (0.1,0,0) (0,0.2,0) (0,0,0.027)\n"), std::string::npos);
  EXPECT_NE(text.find("\nspace origin: (-1.5,0,2)\n"), std::string::npos);
  EXPECT_NE(text.find("\nvalues:=two\\nlines\n\n"), std::string::npos);
}

TEST(Gzip, ReadsBackWhateverThePieces) {
  for (const size_t width : {5, 300, 20000}) {
    const std::string bytes = numbers(width, 100);
    const std::string stream = zip(bytes, 4, 4 * width, bytes.size());
    EXPECT_LT(stream.size(), bytes.size());
    EXPECT_TRUE(unzip(stream, bytes.size()) == bytes) << width;
    EXPECT_TRUE(unzip(zip(bytes, 4, 4 * width, 777), bytes.size()) == bytes) << width;
  }
  EXPECT_EQ(unzip(zip("", 1, 10, 1), 0), "");
  EXPECT_EQ(unzip(zip("abc", 1, 3, 1), 3), "abc");
}

TEST(Gzip, RowsThatRepeatCostLittle) {
  std::string bytes;
  for (size_t j = 0; j < 500; ++j)
    for (size_t i = 0; i < 1000; ++i) bytes += static_cast<char>(i * i % 251);
  EXPECT_LT(zip(bytes, 1, 1000, bytes.size()).size(), bytes.size() / 100);
}

}  // namespace ombre::formats
