// Any bytes as a volume, alone, with a description, or as a header beside numbers: a grid that can be used, or a
// message.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/text/error.h"
#include "formats/volumes/page_axes.h"
#include "import/fields/volume_source.h"

namespace {

void exercise(const std::string& bytes, const std::string* companion, bool may_refer) {
  try {
    ombre::formats::companion_of("fuzz.nrrd", bytes);
    const std::string path = "fuzz.nrrd";
    const std::string_view rest = companion ? std::string_view(*companion) : std::string_view();
    auto volume = ombre::formats::read_volume({path, bytes, companion ? &rest : nullptr, {}, may_refer});
    const auto made = ombre::importing::make_volume_source("fuzz", std::move(volume), {});
    const ombre::Box box = made.source->bounds();
    for (const int channel : {0, 1, 2, 3, 4, 5}) {
      const double value = made.source->sample(channel, box.center());
      if ((channel < 2 && !made.range.contains(value)) || !made.source->range(channel, box).contains(value))
        std::abort();
    }
  } catch (const ombre::Error&) {
    return;
  }
}

// Any text as the description of a TIFF file's pages.
void describe_pages(const std::string& text) {
  try {
    const auto axes = ombre::formats::page_axes("fuzz.tif", text);
    if (axes && axes->plane(axes->slices - 1, axes->channels - 1, axes->frames - 1) != axes->count() - 1) std::abort();
  } catch (const ombre::Error&) {
    return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  exercise(bytes, nullptr, false);
  exercise(bytes, nullptr, true);
  describe_pages(bytes);
  // What follows an empty line is the companion, and the other way round.
  const size_t gap = bytes.find("\n\n");
  if (gap == std::string::npos) return 0;
  const std::string head = bytes.substr(0, gap + 1), rest = bytes.substr(gap + 2);
  exercise(head, &rest, true);
  exercise(rest, &head, false);
  return 0;
}
