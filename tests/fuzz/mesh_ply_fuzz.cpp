// Any bytes as PLY: a mesh that can be used, or a message.
#include <cstdint>
#include <cstdlib>

#include "formats/mesh/mesh.h"
#include "import/surfaces/exercise_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ombre::Diagnostics diagnostics;
  auto mesh = ombre::formats::read_ply("fuzz.ply", bytes, diagnostics);
  if (mesh.has_value() == diagnostics.has_errors()) std::abort();
  if (mesh)
    ombre::importing::test::exercise(std::move(*mesh));
  else
    ombre::to_text(diagnostics);
  return 0;
}
