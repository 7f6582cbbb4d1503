// Any bytes as a JPEG image: pixels, as many as it says, turned as its camera noted, or a message.
#include <cstdint>
#include <cstdlib>

#include "base/text/error.h"
#include "jpeg/orientation.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const int orientation = ombre::jpeg::orientation_of(bytes);
  try {
    constexpr uint64_t most_pixels = 1 << 20;
    const auto picture = ombre::jpeg::turned(ombre::jpeg::decode("fuzz.jpg", bytes, most_pixels), orientation);
    if (picture.rgba.size() != size_t{4} * picture.width * picture.height) std::abort();
  } catch (const ombre::Error&) {
    return 0;
  }
  return 0;
}
