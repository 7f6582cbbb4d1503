// Any bytes as SVG: a drawing, or a message.
#include "formats/drawings/plane_files.h"
#include "fuzz/reads_or_reports.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return ombre::fuzz::reads_drawing(data, size, "fuzz.svg", ombre::formats::read_svg);
}
