#include "formats/containers/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <random>

#include "formats/containers/zlib_stream.h"

namespace ombre::formats {
namespace {

using Bytes = std::vector<uint8_t>;

// Returns the bytes that zlib decodes from the stream.
Bytes inflate_all(const DeflateWriter& writer, size_t expected) {
  Bytes bytes(expected + 1);
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
  Bytes in(writer.data(), writer.data() + writer.size());
  stream.next_in = in.data();
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = bytes.data();
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END) << (stream.msg ? stream.msg : "");
  EXPECT_EQ(stream.avail_in, 0U);
  bytes.resize(stream.total_out);
  inflateEnd(&stream);
  return bytes;
}

// Writes bytes to the stream and records them.
struct Recorder {
  DeflateWriter writer;
  Bytes bytes;

  void literals(const Bytes& more) {
    writer.literals(more.data(), more.size());
    bytes.insert(bytes.end(), more.begin(), more.end());
  }
  void match(uint32_t length, uint32_t distance) {
    writer.match(length, distance);
    for (uint32_t i = 0; i < length; ++i) bytes.push_back(bytes[bytes.size() - distance]);
  }
  void expect_same() {
    writer.finish();
    EXPECT_EQ(inflate_all(writer, bytes.size()), bytes);
  }
};

Bytes random_bytes(size_t count, uint32_t values, std::mt19937& random) {
  Bytes bytes(count);
  for (uint8_t& byte : bytes) byte = static_cast<uint8_t>(random() % values);
  return bytes;
}

}  // namespace

TEST(Deflate, EveryLengthAndManyDistances) {
  Recorder recorder;
  std::mt19937 random(1);
  recorder.literals(random_bytes(32768, 256, random));
  for (uint32_t length = 3; length < 800; ++length) recorder.match(length, 1 + static_cast<uint32_t>(random()) % 32768);
  for (uint32_t distance = 1; distance <= 32768; distance = distance * 9 / 8 + 1) recorder.match(5, distance);
  recorder.match(3, 32768);
  recorder.expect_same();
}

TEST(Deflate, StreamsOfManyBlocks) {
  for (const uint32_t values : {1U, 2U, 7U, 256U}) {
    Recorder recorder;
    std::mt19937 random(values);
    recorder.literals({1});
    for (int i = 0; i < 60000; ++i) {
      if (random() % 3) recorder.literals(random_bytes(random() % 6, values, random));
      const auto far = static_cast<uint32_t>(std::min<size_t>(recorder.bytes.size(), 40));
      recorder.match(3 + static_cast<uint32_t>(random()) % 20, 1 + static_cast<uint32_t>(random()) % far);
    }
    recorder.expect_same();
  }
}

TEST(Deflate, LongMatchesAndNoMatches) {
  Recorder zeros;
  zeros.literals({0});
  for (int i = 0; i < 5; ++i) zeros.match(10'000'000, 1);
  zeros.expect_same();
  EXPECT_LT(zeros.writer.size(), 60'000U);  // 258 bytes need at least two bits

  for (const size_t count : {size_t{1}, size_t{65536}, size_t{131072}, size_t{200001}}) {
    Recorder plain;
    std::mt19937 random(static_cast<uint32_t>(count));
    plain.literals(random_bytes(count, 200, random));
    plain.expect_same();
  }
}

TEST(Deflate, LiteralsTakeTheirEntropy) {
  Recorder recorder;
  std::mt19937 random(5);
  recorder.literals(random_bytes(1'000'000, 8, random));
  recorder.expect_same();
  EXPECT_LT(static_cast<double>(recorder.writer.size()), 1.05 * 1'000'000 * 3 / 8);
}

TEST(Adler32, AgreesWithZlib) {
  std::mt19937 random(1);
  Adler32 sum;
  uLong expected = adler32(0, nullptr, 0);
  for (const uint32_t times : {1U, 2U, 3U, 1000U, 65521U, 100'003U, 1'000'000U}) {
    const Bytes some = random_bytes(1 + random() % 500, 256, random), pixel = random_bytes(4, 256, random);
    sum.add(some.data(), some.size());
    expected = adler32(expected, some.data(), static_cast<uInt>(some.size()));
    sum.add_repeated({pixel[0], pixel[1], pixel[2], pixel[3]}, times);
    for (uint32_t i = 0; i < times; ++i) expected = adler32(expected, pixel.data(), 4);
    EXPECT_EQ(sum.value(), expected) << times;
  }
}

}  // namespace ombre::formats
