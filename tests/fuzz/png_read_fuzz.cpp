// Any bytes as a PNG image: pixels, as many as it says, in colour and in shades of grey, or a message.
#include <cstdint>
#include <cstdlib>

#include "base/text/error.h"
#include "formats/images/png.h"

namespace {

using namespace ombre::formats;

constexpr uint64_t most_pixels = 1 << 20;

uint64_t values_per_pixel(const PngImage& image) { return image.format == ombre::ImageFormat::indexed ? 1 : 4; }
uint64_t values_per_pixel(const GrayImage&) { return 1; }

template <class Image>
void check(std::string_view bytes, Image decode(std::string_view, const std::string&, uint64_t)) {
  try {
    const Image image = decode(bytes, "fuzz.png", most_pixels);
    if (image.pixels.size() != values_per_pixel(image) * image.width * image.height) std::abort();
  } catch (const ombre::Error&) {
    return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  check(bytes, decode_png);
  check(bytes, decode_gray_png);
  return 0;
}
