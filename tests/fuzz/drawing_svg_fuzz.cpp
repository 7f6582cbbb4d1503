// Any bytes as SVG: a drawing, or a message.
#include "formats/drawings/plane_files.h"
#include "fuzz/reads_or_reports.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return ombre::fuzz::reads_or_reports(
      data, size,
      [](std::string_view bytes, ombre::Diagnostics& diagnostics) {
        return ombre::formats::read_svg("fuzz.svg", bytes, {}, diagnostics);
      },
      [](const auto&) {});
}
