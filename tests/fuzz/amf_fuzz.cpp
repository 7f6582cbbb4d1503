// Any bytes as AMF, text or zipped: a mesh that can be used, or a message.
#include <cstdint>
#include <cstdlib>

#include "formats/mesh/mesh.h"
#include "formats/packages/package_readers.h"
#include "import/surfaces/exercise_mesh.h"

// Repeated objects make large meshes of few bytes.
constexpr size_t most_exercised = 10'000;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ombre::Diagnostics diagnostics;
  auto mesh = ombre::formats::read_amf("fuzz.amf", bytes, diagnostics);
  if (mesh.has_value() == diagnostics.has_errors()) std::abort();
  if (!mesh)
    ombre::to_text(diagnostics);
  else if (mesh->triangles.size() <= most_exercised)
    ombre::importing::test::exercise(std::move(*mesh));
  return 0;
}
