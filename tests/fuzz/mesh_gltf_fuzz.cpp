// Any bytes as glTF: names of files beside it, and a mesh that can be used, or a message.
#include "formats/mesh/files_beside.h"
#include "fuzz/reads_or_reports.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  (void)ombre::formats::gltf_files("fuzz.glb", ombre::fuzz::bytes_of(data, size));
  return ombre::fuzz::reads_mesh(data, size, "fuzz.glb",
                                 [](const std::string& name, std::string_view bytes, ombre::Diagnostics& diagnostics) {
                                   return ombre::formats::read_gltf(name, bytes, diagnostics);
                                 });
}
