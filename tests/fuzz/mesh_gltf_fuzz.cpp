// Any bytes as glTF: a mesh that can be used, or a message.
#include "fuzz/reads_or_reports.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return ombre::fuzz::reads_mesh(data, size, "fuzz.glb", ombre::formats::read_gltf);
}
