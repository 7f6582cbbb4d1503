// Any bytes as SVG: a drawing, or a message.
#include <cstdint>
#include <cstdlib>

#include "formats/drawings/plane_files.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ombre::Diagnostics diagnostics;
  const auto drawing = ombre::formats::read_svg("fuzz.svg", bytes, {}, diagnostics);
  if (drawing.has_value() == diagnostics.has_errors()) std::abort();
  ombre::to_text(diagnostics);
  return 0;
}
