// Any bytes as 3MF: an archive, or else the model file within one. A mesh that can be used, or a message.
#include <cstdint>
#include <cstdlib>

#include "formats/mesh.h"
#include "formats/three_mf_model.h"
#include "import/exercise_mesh.h"

namespace {

// Repeated objects make large meshes of few bytes.
constexpr size_t most_exercised = 10'000;

std::optional<ombre::formats::Mesh> read_model(std::string_view bytes, ombre::Diagnostics& diagnostics) {
  using namespace ombre::formats;
  try {
    const XmlFile file("fuzz.model", bytes, diagnostics);
    Assembly assembly;
    std::set<std::string> further;
    add_objects(file, "fuzz.model", assembly, further);
    add_build(file, "fuzz.model", assembly, further);
    return assemble(assembly, "fuzz.3mf", diagnostics);
  } catch (const ombre::DesignError&) {
    return std::nullopt;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ombre::Diagnostics diagnostics;
  auto mesh = bytes.starts_with("PK") ? ombre::formats::read_3mf("fuzz.3mf", bytes, diagnostics)
                                      : read_model(bytes, diagnostics);
  if (mesh.has_value() == diagnostics.has_errors()) std::abort();
  if (!mesh)
    ombre::to_text(diagnostics);
  else if (mesh->triangles.size() <= most_exercised)
    ombre::importing::test::exercise(std::move(*mesh));
  return 0;
}
