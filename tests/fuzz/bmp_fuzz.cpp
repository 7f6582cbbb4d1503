// Any bytes as a BMP image: pixels, as many as it says, or a message.
#include <cstdint>
#include <cstdlib>

#include "base/text/error.h"
#include "formats/images/bmp.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const ombre::formats::BmpImage image = ombre::formats::decode_bmp(bytes, "fuzz.bmp");
    if (image.rgba.size() != size_t{4} * image.width * image.height) std::abort();
  } catch (const ombre::Error&) {
    return 0;
  }
  return 0;
}
