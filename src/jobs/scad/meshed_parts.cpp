#include "jobs/scad/meshed_parts.h"

#include "jobs/mesh/mesh_job.h"
#include "questions/build.h"

namespace ombre::compile {

std::optional<solids::Pieces> meshed_parts(const LoadedPtr& loaded, Diagnostics& diagnostics, const StopFlag* stop) {
  constexpr size_t memory = size_t{4} << 30;
  MeshRequest request;
  request.memory_bytes = memory;
  request.keeps_polyhedra = true;
  // All parts are as fine as the whole would be.
  const auto box = design_box(loaded->design, diagnostics);
  const auto fineness = box ? choose_fineness(loaded->design, *box, request, diagnostics) : std::nullopt;
  if (!fineness) return std::nullopt;
  request.tolerance_mm = fineness->tolerance_mm;
  request.cell_mm = fineness->cell.mm();
  solids::Pieces pieces;
  for (const design::Part& part : loaded->design.parts) {
    Loaded alone = *loaded;
    alone.design.parts = {part};
    auto made = mesh_design(alone, request, diagnostics, nullptr, stop);
    if (!made) return std::nullopt;
    const bool has_name = loaded->design.parts.size() > 1 || part.name != design::nameless_part;
    for (RegionBody& body : made->bodies) {
      solids::Attributes attributes{"", has_name ? part.name : "", solids::Colour{}};
      for (size_t n = 0; n < body.colour.size(); ++n) (*attributes.colour)[n] = body.colour[n] / 255.0;
      solids::TriangleMesh mesh{std::move(body.body.vertices), std::move(body.body.triangles)};
      pieces.push_back({std::move(attributes), solids::Solid(std::move(mesh))});
    }
  }
  return pieces;
}

}  // namespace ombre::compile
