// Any bytes as a volume, alone, with a description, or as a header beside numbers: a grid that can be used, or a
// message.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/error.h"
#include "import/volume_source.h"

namespace {

void exercise(const std::string& bytes, const std::string* companion) {
  try {
    ombre::formats::companion_of("fuzz.nrrd", bytes);
    auto volume = ombre::formats::read_volume("fuzz.nrrd", bytes, companion);
    const auto made = ombre::importing::make_volume_source("fuzz", std::move(volume), {});
    const ombre::Box box = made.source->bounds();
    for (const int channel : {0, 1}) {
      const double value = made.source->sample(channel, box.center());
      if (!made.range.contains(value) || !made.source->range(channel, box).contains(value)) std::abort();
    }
  } catch (const ombre::Error&) {
    return;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  exercise(bytes, nullptr);
  // What follows an empty line is the companion, and the other way round.
  const size_t gap = bytes.find("\n\n");
  if (gap == std::string::npos) return 0;
  const std::string head = bytes.substr(0, gap + 1), rest = bytes.substr(gap + 2);
  exercise(head, &rest);
  exercise(rest, &head);
  return 0;
}
