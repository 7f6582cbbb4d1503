// Any bytes as 3MF: an archive, or else the model file or a slicer's settings within one. A mesh that can be used, or a
// message.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "formats/mesh/mesh.h"
#include "formats/packages/package_readers.h"
#include "formats/packages/three_mf_model.h"
#include "formats/packages/three_mf_volumes.h"
#include "import/fields/beam_source.h"
#include "import/surfaces/exercise_mesh.h"

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

// An object of three triangles, and one that holds it.
ombre::formats::Assembly small_assembly() {
  using namespace ombre::formats;
  Assembly assembly;
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 1, 2}};
  mesh.groups = {{"", 0, 1}, {"", 1, 2}};
  assembly.objects[object_key("", 1)] = {"one", mesh, {}};
  assembly.objects[object_key("", 2)] = {"two", {}, {{object_key("", 1), {}}}};
  assembly.build = {{object_key("", 1), {}}, {object_key("", 2), {}}};
  return assembly;
}

std::optional<ombre::formats::Mesh> read_settings(std::string_view bytes, ombre::Diagnostics& diagnostics) {
  using namespace ombre::formats;
  try {
    const XmlFile file("fuzz.config", bytes, diagnostics);
    Assembly assembly = small_assembly();
    apply_prusa_volumes(file, "", ExtruderColours::of_prusa(bytes), assembly);
    apply_bambu_parts(file, "", ExtruderColours::of_bambu("{\"filament_colour\": [\"#FF0000\"]}"), assembly);
    return assemble(assembly, "fuzz.3mf", diagnostics);
  } catch (const ombre::DesignError&) {
    return std::nullopt;
  }
}

// Asks for rows of sixteen voxels across, whatever the size, and for a distance.
void exercise(const ombre::formats::PlacedLattice& placed) {
  using namespace ombre;
  const program::SourceField source = importing::make_beam_source("fuzz", placed, {});
  const Box box = source->bounds();
  source->sample(source->channel("distance"), box.center());
  const double pitch = std::max({box.size().x, box.size().y, box.size().z, 1e-300}) / 16;
  const Affine map = Affine::translation(box.lo) * Affine::scaling({pitch, pitch, pitch});
  const auto rows = source->rows(source->channel("inside"), map);
  if (!rows) return;
  std::vector<std::vector<program::Span>> spans;
  for (int64_t k = -1; k <= 17; ++k) {
    rows->layer(k, -1, 17, 17, spans);
    for (const auto& row : spans) {
      int64_t end = 0;
      for (const program::Span& span : row) {
        if (span.begin < end || span.end <= span.begin || span.end > 17) std::abort();
        end = span.end;
      }
    }
  }
}

std::optional<ombre::formats::Mesh> read(std::string_view bytes, ombre::Diagnostics& diagnostics) {
  if (bytes.starts_with("PK")) return ombre::formats::read_3mf("fuzz.3mf", bytes, diagnostics);
  return bytes.starts_with("<config") ? read_settings(bytes, diagnostics) : read_model(bytes, diagnostics);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ombre::Diagnostics diagnostics;
  auto mesh = read(bytes, diagnostics);
  if (mesh.has_value() == diagnostics.has_errors()) std::abort();
  if (!mesh) {
    ombre::to_text(diagnostics);
    return 0;
  }
  for (const ombre::formats::PlacedLattice& placed : mesh->lattices)
    if (placed.lattice->beams.size() + placed.lattice->balls.size() <= most_exercised) exercise(placed);
  if (!mesh->triangles.empty() && mesh->triangles.size() <= most_exercised)
    ombre::importing::test::exercise(std::move(*mesh));
  return 0;
}
